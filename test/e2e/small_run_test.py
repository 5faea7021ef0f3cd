"""Small runs of every case: they finish, write what the documents promise, and agree on 1, 2 and 3 ranks."""

import unittest

from programs import run, settings

OK, MISSED_REFERENCE = 0, 7
# Settings small enough for seconds, with tolerances tight enough to compare ranks.
CASES = {
    "taylor_green": settings(mesh__n=6, mesh__element="quad1", time__dt=0.1, time__end=0.3, newton__rtol=1e-12),
    "kovasznay": settings(mesh__n=8, sweep="none", mesh__element="tri2", newton__rtol=1e-12),
    "cavity": settings(mesh__n=12, newton__rtol=1e-12),
    "cylinder": settings(mesh__refinement=0.3, newton__rtol=1e-12),
    "sphere": settings(mesh__n=3, time__dt=5e-3, time__end=0.02, newton__rtol=1e-10),
    "semilunar_valve": settings(mesh__h=0.7, mesh__h_valve=0.35, time__dt=2e-3, time__end=2e-3, newton__rtol=1e-10,
                                coupling__s_max=10),
    "sphere elastic": settings(body="elastic", mesh__n=3, time__dt=5e-3, time__end=0.02, newton__rtol=1e-10),
    "sphere elastic in space": settings(model="quarter3d", body="elastic", mesh__n=2.5, time__dt=1e-2, time__end=0.02,
                                        newton__rtol=1e-10),
}
TAYLOR_GREEN_3D = settings(mesh__n=3, mesh__element="hex1", time__dt=0.05, time__end=0.1, newton__rtol=1e-12)


class SmallRuns(unittest.TestCase):
    def assert_same_metrics(self, one, other):
        self.assertEqual(one.summary["metrics"].keys(), other.summary["metrics"].keys())
        for name, value in one.summary["metrics"].items():
            self.assertAlmostEqual(other.summary["metrics"][name], value, delta=1e-7 * max(abs(value), 1e-6), msg=name)

    def small(self, case, options, ranks=1):
        outcome = run(case, *options, ranks=ranks)
        self.assertIn(outcome.code, (OK, MISSED_REFERENCE), outcome.output)
        self.assertEqual(outcome.code == OK, all(check["pass"] for check in outcome.summary["checks"]))
        return outcome

    def test_same_answer_on_any_number_of_ranks(self):
        for case, options in {**CASES, "taylor_green 3D": TAYLOR_GREEN_3D}.items():
            with self.subTest(case):
                case = case.split()[0]
                one = self.small(case, options)
                self.assertGreater(len(one.summary["metrics"]), 1)
                for ranks in (2, 3):
                    other = self.small(case, options, ranks)
                    self.assertEqual(other.summary["ranks"], ranks)
                    self.assert_same_metrics(one, other)

    def test_summary_and_files(self):
        outcome = self.small("cavity", CASES["cavity"])
        for field in ["case", "ranks", "threads", "dofs", "steps", "newton_total", "gmres_total", "wall_s", "cpu_s",
                      "peak_rss_mb", "metrics", "checks", "version", "commit", "compiler", "flags", "processor"]:
            self.assertIn(field, outcome.summary)
        self.assertEqual(set(outcome.summary["checks"][0]),
                         {"name", "value", "reference", "tolerance", "pass", "source"})
        self.assertEqual(outcome.summary["case"], "cavity")
        self.assertEqual(outcome.summary["dofs"], 13 * 13 * 3)
        self.assertGreater(outcome.summary["newton_total"], 2)
        for name in ["fluid.pvd", "log.txt", "summary.json"]:
            self.assertIn(name, outcome.files)

    def test_linear_solvers_agree(self):
        direct, gmres = (self.small("cavity", CASES["cavity"] + settings(linear__method=method))
                         for method in ("direct", "gmres"))
        self.assertGreater(gmres.summary["gmres_total"], direct.summary["gmres_total"])
        self.assert_same_metrics(direct, gmres)

    def test_missed_reference_fails_the_run(self):
        outcome = run("cavity", *settings(mesh__n=4))
        self.assertEqual(outcome.code, MISSED_REFERENCE)
        self.assertIn("FAILED", outcome.output)


if __name__ == "__main__":
    unittest.main()
