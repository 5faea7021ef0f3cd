"""What a user does wrong: each ends with one clear message, which says what was expected, and with its exit code."""

import os
import pathlib
import unittest
import unittest.mock

from programs import folder, run, settings

CONFIGURATION, FILE, NONLINEAR = 1, 2, 4


class BadInput(unittest.TestCase):
    def assert_refused(self, outcome, code, *parts):
        self.assertEqual(outcome.code, code, outcome.output)
        for part in parts:
            self.assertIn(part, outcome.output)
        self.assertEqual(outcome.output.count("error:"), 1, outcome.output)
        self.assertEqual(outcome.summary, {})

    def test_unknown_key(self):
        self.assert_refused(run("cavity", *settings(mash__n=8)), CONFIGURATION, "unknown key 'mash.n'",
                            "did you mean 'mesh.n'?", "there are: Re, mesh.n")

    def test_unknown_key_in_a_file(self):
        with folder() as scratch:
            file = scratch / "mine.toml"
            file.write_text('Re = 100\n[mesh]\nn = 8\nelment = "quad1"\n')
            self.assert_refused(run("cavity", config=file), CONFIGURATION, f"{file}:4: unknown key 'mesh.elment'",
                                "did you mean 'mesh.element'?")

    def test_wrong_type(self):
        self.assert_refused(run("cavity", *settings(mesh__n="many")), CONFIGURATION,
                            'mesh.n = "many" has the wrong type', "expected an integer")

    def test_out_of_range(self):
        self.assert_refused(run("cavity", *settings(mesh__n=1)), CONFIGURATION, "mesh.n = 1 is out of range", "[4, 1024]")

    def test_not_a_number(self):
        self.assert_refused(run("cavity", *settings(Re="nan")), CONFIGURATION, "Re = nan", "[1, 1000]")

    def test_unknown_choice(self):
        self.assert_refused(run("cavity", *settings(mesh__element="quad3")), CONFIGURATION, "did you mean 'quad1'?",
                            "there are: quad1, quad2, tri1, tri2")

    def test_unknown_preset(self):
        self.assert_refused(run("cylinder", *settings(preset="2D-4")), CONFIGURATION, "2D-4", "2D-2", "2D-3", "3D-1Z")

    def test_unknown_option(self):
        self.assert_refused(run("cavity", "--frob"), CONFIGURATION, "--frob")

    def test_broken_file(self):
        with folder() as scratch:
            file = scratch / "mine.toml"
            file.write_text("Re = 100\nmesh.n = = 8\n")
            self.assert_refused(run("cavity", config=file), CONFIGURATION, f"{file}:2: not valid TOML")

    def test_missing_file(self):
        self.assert_refused(run("cavity", config="nothing.toml"), FILE, "cannot read 'nothing.toml'")

    def test_missing_reference(self):
        self.assert_refused(run("cavity", *settings(mesh__n=4, data="nowhere")), FILE, "nowhere")

    def test_unwritable_output(self):
        with folder() as scratch:
            (scratch / "file").write_text("")
            self.assert_refused(run("cavity", out=scratch / "file" / "out"), FILE, "cannot write in the output folder",
                                "--out DIR")

    def test_nothing_to_restart_from(self):
        self.assert_refused(run("taylor_green", "--restart"), FILE, "checkpoint")

    def test_more_ranks_than_cells(self):
        self.assert_refused(run("taylor_green", *settings(mesh__n=2), ranks=5), CONFIGURATION, "4 cells", "5 ranks")

    def test_one_message_from_several_ranks(self):
        self.assert_refused(run("cavity", *settings(mesh__n="many"), ranks=2), CONFIGURATION, "has the wrong type")

    def test_a_cut_that_is_no_symmetry_plane(self):
        self.assert_refused(run("sphere", *settings(model="quarter3d", solid__offset=0.01)), CONFIGURATION,
                            "no plane of symmetry", "solid.offset = 0.01", "expected solid.offset = 0", "rigid3d")

    def test_a_sector_that_is_no_sixth(self):
        self.assert_refused(run("semilunar_valve", *settings(sector__angle=45)), CONFIGURATION, "sector.angle = 45",
                            "no plane of symmetry", "expected 60")

    def test_leaflets_that_leave_the_vessel(self):
        self.assert_refused(run("semilunar_valve", *settings(mesh__h_valve=0.35, mesh__h=0.7, solid__protrusion=0.2)),
                            CONFIGURATION, "nodes of the leaflets lie outside of the vessel by up to 0.2",
                            "solid.protrusion_max = 0.08")

    def test_seals_that_mean_nothing(self):
        self.assert_refused(run("semilunar_valve", *settings(contact__seal=-1)), CONFIGURATION,
                            "contact.seal = -1 is out of range")
        self.assert_refused(run("semilunar_valve", *settings(solid__fibres=-1)), CONFIGURATION,
                            "solid.fibres = -1 is out of range")

    def test_flow_curve_that_jumps_back(self):
        with folder() as scratch:
            file = scratch / "flow.csv"
            file.write_text("t [s],q [cm^3/s]\n0,0\n0.2,1\n0.1,2\n")
            self.assert_refused(run("semilunar_valve", *settings(inlet__curve=file)), FILE, f"{file}:4", "ascending")

    def test_no_gmsh(self):
        # On its own Open MPI would look for its daemon in PATH.
        empty = {"PATH": "nowhere", "OMPI_MCA_ess_singleton_isolated": "1"}
        with unittest.mock.patch.dict(os.environ, empty):
            self.assert_refused(run("semilunar_valve"), CONFIGURATION, "gmsh", "apt-get install gmsh")

    def test_incompressible_solid_in_a_displacement_formulation(self):
        self.assert_refused(run("turek_hron", *settings(solid__nu=0.5)), CONFIGURATION, "solid.nu = 0.5 is out of range",
                            "0.4999")

    def test_a_thick_solid_finer_than_the_fluid(self):
        def notes(n):
            outcome = run("annulus", *settings(sweep="none", mesh__n=n, time__end=1e-3, solid__around=28))
            return [line for line in outcome.output.splitlines() if line.startswith("note:")]
        self.assertEqual(notes(16), [])  # one fluid cell thick
        self.assertIn("solid nodes per fluid node", notes(48)[0])

    def test_newton_that_gives_up(self):
        outcome = run("taylor_green", *settings(mesh__n=4, newton__max_iterations=1, newton__rtol=1e-14,
                                                time__dt_min_factor=0.5))
        self.assert_refused(outcome, NONLINEAR, "no convergence in 1 iterations", "dt")


class Questions(unittest.TestCase):
    """What only asks computes nothing and leaves no folder."""

    def test_parameters(self):
        outcome = run("cylinder", "--params")
        self.assertEqual((outcome.code, outcome.files), (0, []))
        for word in ["key", "default", "unit", "range", "help", "mesh.element", "time.dt"]:
            self.assertIn(word, outcome.output)

    def test_description_is_that_of_the_list(self):
        for case in ["cavity", "cylinder", "kovasznay", "taylor_green"]:
            outcome = run(case, "--describe")
            self.assertEqual((outcome.code, outcome.files), (0, []))
            self.assertEqual(outcome.output.count("\n"), 1)

    def test_configuration_can_be_printed_and_read_again(self):
        with folder() as scratch:
            file = pathlib.Path(scratch, "printed.toml")
            file.write_text(run("cavity", "--print-config", *settings(mesh__n=12)).output)
            self.assertEqual(run("cavity", "--print-config", config=file).output, file.read_text())
            self.assertIn("12", file.read_text())


if __name__ == "__main__":
    unittest.main()
