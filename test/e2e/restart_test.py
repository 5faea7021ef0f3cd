"""A run that is stopped writes a checkpoint; continued from it, on any number of ranks, it ends as if never stopped."""

import signal
import unittest

from programs import folder, run, run_and_disturb, settings

OK, STOPPED = 0, 6
STEPS = 2000
OPTIONS = settings(mesh__n=6, time__dt=0.5 / STEPS, time__end=0.5, newton__rtol=1e-11)


class Restart(unittest.TestCase):
    def stop(self, out, disturb):
        outcome = run_and_disturb("taylor_green", *OPTIONS, out=out, disturb=disturb)
        self.assertEqual(outcome.code, STOPPED, outcome.output)
        self.assertIn("stopped at t = ", outcome.output)
        self.assertTrue(any("checkpoint" in name for name in outcome.files), outcome.files)

    def test_stop_file_and_restart(self):
        undisturbed = run("taylor_green", *OPTIONS)
        self.assertEqual(undisturbed.code, OK, undisturbed.output)
        for ranks in (1, 2):
            with self.subTest(ranks=ranks), folder() as out:
                self.stop(out, lambda process: (out / "STOP").touch())
                resumed = run("taylor_green", *OPTIONS, "--restart", out=out, ranks=ranks)
                self.assertEqual(resumed.code, OK, resumed.output)
                self.assertLess(resumed.summary["steps"], STEPS)
                for name, value in undisturbed.summary["metrics"].items():
                    self.assertAlmostEqual(resumed.summary["metrics"][name], value, delta=1e-8 * abs(value), msg=name)

    def test_signals(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            with self.subTest(number), folder() as out:
                self.stop(out, lambda process: process.send_signal(number))

    def test_damaged_checkpoint(self):
        with folder() as out:
            self.stop(out, lambda process: (out / "STOP").touch())
            for checkpoint in out.glob("*checkpoint*"):
                content = bytearray(checkpoint.read_bytes())
                content[len(content) // 2] ^= 1
                checkpoint.write_bytes(content)
            outcome = run("taylor_green", *OPTIONS, "--restart", out=out)
            self.assertEqual(outcome.code, 2, outcome.output)
            self.assertIn("checkpoint", outcome.output)


if __name__ == "__main__":
    unittest.main()
