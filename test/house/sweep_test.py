"""Sweeps with a stand-in for a driver: grid, judgement, refusals, and that finished runs are not repeated."""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Result 1 + 10 dt; refuses dt > 1; warns when asked to. Counts its calls.
DRIVER = """#!/bin/sh
while [ $# -gt 0 ]; do
  case $1 in --out) out=$2;; time.dt=*) dt=${1#*=};; loud=true) echo 'warning: coarse';; esac; shift
done
echo call >> "$(dirname "$0")/calls"
case $dt in 5*) echo "step to t = 1 rejected"; echo "Newton fails"; echo "step to t = 1 rejected" >> "$out/log.txt"; exit 4;; esac
echo "{\\"steps\\": 3, \\"metrics\\": {\\"x\\": $(echo "1 $dt" | awk '{print $1 + 10 * $2}')}}" > "$out/summary.json"
"""
SWEEP = """# Test
[[map]]
name = "dt"
case = "stub"
metrics = ["x"]
reference = { "time.dt" = 0.0 }
tolerance = 0.05
axes = [ { key = "time.dt", values = [0.001, 0.01, 5] }, [ { label = "a", set = {} }, { label = "b", set = { loud = true } } ] ]
"""


class Sweep(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        driver = self.root / "drivers" / "stub"
        driver.parent.mkdir()
        driver.write_text(DRIVER)
        driver.chmod(0o755)
        (self.root / "sweep.toml").write_text(SWEEP)

    def tearDown(self):
        self.folder.cleanup()

    def sweep(self, *options):
        return subprocess.run([sys.executable, ROOT / "scripts/sweep/sweep.py", self.root / "sweep.toml", self.root,
                               self.root / "out", *options], capture_output=True, text=True, check=False, env=os.environ)

    def test_grid_is_judged(self):
        done = self.sweep()
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.root / "out" / "dt.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["status"] for row in rows], ["right", "right", "off", "warned", "refused", "refused"])
        self.assertAlmostEqual(float(rows[2]["error"]), 0.1)
        self.assertEqual(rows[4]["reason"], "step control: Newton fails")
        self.assertEqual(rows[4]["cuts"], "1")
        self.assertEqual(rows[0]["axis0"], "time.dt=0.001")

    def test_finished_runs_are_kept(self):
        self.sweep()
        calls = (self.root / "drivers" / "calls").read_text()
        self.assertEqual(calls.count("call"), 7)  # six points and one reference
        self.sweep()
        self.assertEqual((self.root / "drivers" / "calls").read_text(), calls)

    def test_unknown_map(self):
        done = self.sweep("--only", "dx")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no map 'dx'; there are: dt", done.stderr)

    def test_every_sweep_of_ours_names_drivers(self):
        for file in (ROOT / "data" / "sweeps").glob("*.toml"):
            done = subprocess.run([sys.executable, ROOT / "scripts/sweep/sweep.py", file, ".", ".", "--cases"],
                                  capture_output=True, text=True, check=True)
            for case in done.stdout.split():
                self.assertTrue((ROOT / "drivers" / f"{case}.cpp").exists(), f"{file.name}: {case}")


if __name__ == "__main__":
    unittest.main()
