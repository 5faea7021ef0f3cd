"""The launcher `ifsi` in a small tree of its own, with stand-ins for Debian's tools, CMake, mpirun and the programs."""

import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Without arguments dpkg-query knows everything to be installed; PACKAGES_ABSENT names exceptions.
DPKG_QUERY = """for p; do case $p in -*) ;; *) case " $PACKAGES_ABSENT " in *" $p "*) ;; *) echo "$p installed";; esac;;
esac; done"""
PROGRAM = """echo "arguments: $*"
while [ $# -gt 0 ]; do [ "$1" = --out ] && out=$2; shift; done
mkdir -p "$out"; echo t > "$out/history.csv"
if [ -n "$WAIT_FOR_STOP" ]; then
  echo running; i=0
  while [ ! -e "$out/STOP" ] && [ $i -lt 200 ]; do sleep 0.05; i=$((i+1)); done
  [ -e "$out/STOP" ] && exit 6
fi
exit ${PROGRAM_CODE:-0}"""


def heed_interrupts():
    """As at a terminal: programs in the background of a script are born deaf to Ctrl-C, and so are their children."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Launcher(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        shutil.copy(ROOT / "ifsi", self.root)
        (self.root / "tools").mkdir()
        shutil.copy(ROOT / "tools" / "nearest.awk", self.root / "tools")
        self.write("drivers/cylinder.cpp", "// source\n")
        self.write("drivers/cavity.cpp", "// source\n")
        self.write("data/cases/cylinder.toml", "# Flow past a cylinder\n")
        self.write("bench/kernels.cpp", "// Time per element\n")
        self.write("scripts/plot/plot.py", "import sys\nprint('plotting', sys.argv[1])\n")
        self.write("build/build.ninja", "")
        self.script("build/drivers/cylinder", PROGRAM)
        self.script("build/bench/bench_kernels", PROGRAM)
        self.script("bin/cmake", 'echo "cmake $*"')
        self.script("bin/dpkg-query", DPKG_QUERY)
        self.script("bin/apt-get", 'echo "apt-get $*" >&2; exit ${APT_CODE:-0}')
        self.script("bin/mpirun", 'echo "mpirun as root: $OMPI_ALLOW_RUN_AS_ROOT, threads $OMP_NUM_THREADS"; '
                                  'while [ "$1" != -n ]; do shift; done; echo "ranks $2"; shift 2; exec "$@"')

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def script(self, name, text):
        self.write(name, "#!/bin/sh\n" + text + "\n")
        (self.root / name).chmod(0o755)

    def environment(self, **extra):
        return {**os.environ, "PATH": f"{self.root}/bin:{os.environ['PATH']}", **extra}

    def ifsi(self, *arguments, **environment):
        return subprocess.run([self.root / "ifsi", *arguments], capture_output=True, text=True, check=False,
                              env=self.environment(**environment))

    def test_run(self):
        done = self.ifsi("run", "cylinder", "--set", "a=b c", "--restart")
        out = self.root / "out" / "cylinder"
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("--target cylinder", done.stdout)
        self.assertIn(f"--out {out} --config {self.root}/data/cases/cylinder.toml --set a=b c --restart", done.stdout)
        self.assertIn(f"plotting {out}", done.stdout)
        self.assertNotIn("mpirun", done.stdout)

    def test_ranks_and_out(self):
        done = self.ifsi("run", "cylinder", "-n", "3", "--out", str(self.root / "else where"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("mpirun as root: 1, threads 1\nranks 3", done.stdout)
        self.assertTrue((self.root / "else where" / "history.csv").exists())

    def test_two_runs_at_once_build_one_after_the_other(self):
        self.script("bin/cmake", f'echo begin >> {self.root}/builds; sleep 0.5; echo end >> {self.root}/builds')
        runs = [subprocess.Popen([self.root / "ifsi", "run", "cylinder", "--out", self.root / name],
                                 stdout=subprocess.DEVNULL, env=self.environment()) for name in ("a", "b")]
        self.assertEqual([run.wait() for run in runs], [0, 0])
        self.assertEqual((self.root / "builds").read_text().split(), ["begin", "end"] * 2)

    def test_own_configuration_replaces_that_of_the_case(self):
        done = self.ifsi("run", "cylinder", "--config", "mine.toml")
        self.assertIn("--config mine.toml", done.stdout)
        self.assertNotIn("cylinder.toml", done.stdout)

    def test_exit_code_is_passed_through(self):
        for code in ["3", "7"]:
            self.assertEqual(self.ifsi("run", "cylinder", PROGRAM_CODE=code).returncode, int(code))
            self.assertEqual(self.ifsi("run", "cylinder", "-n", "2", PROGRAM_CODE=code).returncode, int(code))

    def test_a_killed_program_is_named(self):
        self.script("build/drivers/cylinder", "kill -SEGV $$")
        done = self.ifsi("run", "cylinder")
        self.assertEqual(done.returncode, 139)
        self.assertIn("ended by signal 11", done.stderr)

    def test_unknown_case(self):
        done = self.ifsi("run", "cilynder")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no case is called 'cilynder'; the nearest is 'cylinder'", done.stderr)
        self.assertIn("there are: cavity cylinder", done.stderr)

    def test_wrong_usage(self):
        for arguments, message in [(("run",), "which case?"), (("fly",), "no command is called 'fly'"),
                                   (("run", "cylinder", "-n", "0"), "-n needs a number of ranks, not '0'"),
                                   (("run", "cylinder", "-n"), "-n needs a number of ranks, not ''"),
                                   (("run", "cylinder", "--out"), "--out needs a folder"),
                                   (("bench", "kernel"), "the nearest is 'kernels'"),
                                   (("test", "everything"), "no suite of tests is called 'everything'")]:
            done = self.ifsi(*arguments)
            self.assertEqual(done.returncode, 1, arguments)
            self.assertIn(message, done.stderr)

    def test_list(self):
        self.assertEqual(self.ifsi("list").stdout, "cavity           source\ncylinder         Flow past a cylinder\n")

    def test_bench(self):
        done = self.ifsi("bench", "kernels")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"--out {self.root}/out/bench_kernels", done.stdout)

    def test_failed_build(self):
        self.script("bin/cmake", "exit 2")
        done = self.ifsi("run", "cylinder")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the build failed", done.stderr)

    def test_missing_packages(self):
        done = self.ifsi("run", "cylinder", PACKAGES_ABSENT="libhypre-dev g++")
        if os.geteuid() == 0:
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("install -y --no-install-recommends g++ libhypre-dev", done.stderr + done.stdout)
            done = self.ifsi("run", "cylinder", PACKAGES_ABSENT="g++", APT_CODE="100")
            self.assertIn("could not install: g++", done.stderr)
        else:
            self.assertIn("sudo apt-get install --no-install-recommends g++ libhypre-dev", done.stderr)
        self.assertEqual(done.returncode, 1)

    def test_packages_of_a_case(self):
        self.write("data/cases/cylinder.toml", "# Flow past a cylinder\n# needs: gmsh python3-yaml\n")
        done = self.ifsi("run", "cylinder", PACKAGES_ABSENT="gmsh")
        expected = "install -y" if os.geteuid() == 0 else "sudo apt-get install"
        self.assertIn(expected + " --no-install-recommends gmsh\n", done.stderr + done.stdout + "\n")
        self.write("data/cases/cylinder.toml", "# Flow past a cylinder\n")
        self.assertNotIn("gmsh", self.ifsi("run", "cylinder", PACKAGES_ABSENT="gmsh").stderr)

    def test_missing_plotting_packages_do_not_fail_the_run(self):
        done = self.ifsi("run", "cylinder", PACKAGES_ABSENT="python3-matplotlib", APT_CODE="100")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_interrupt_asks_for_a_checkpoint(self):
        for ranks in ["1", "2"]:
            with subprocess.Popen([self.root / "ifsi", "run", "cylinder", "-n", ranks], stdout=subprocess.PIPE, text=True,
                                  stderr=subprocess.PIPE, env=self.environment(WAIT_FOR_STOP="1"),
                                  preexec_fn=heed_interrupts) as process:
                while process.stdout.readline() != "running\n":
                    pass
                process.send_signal(signal.SIGINT)
                process.communicate(timeout=20)
                self.assertEqual(process.returncode, 6)
            (self.root / "out" / "cylinder" / "STOP").unlink()

    def test_second_interrupt_ends_the_run(self):
        self.script("build/drivers/cylinder", "trap '' INT TERM; echo running; i=0; "
                                              "while [ $i -lt 200 ]; do sleep 0.05; i=$((i+1)); done")
        with subprocess.Popen([self.root / "ifsi", "run", "cylinder"], stdout=subprocess.PIPE, text=True,
                              stderr=subprocess.PIPE, env=self.environment(), preexec_fn=heed_interrupts) as process:
            while process.stdout.readline() != "running\n":
                pass
            process.send_signal(signal.SIGINT)
            while not (self.root / "out" / "cylinder" / "STOP").exists():
                time.sleep(0.05)
            time.sleep(0.2)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=5)
            self.assertEqual(process.returncode, 130)


if __name__ == "__main__":
    unittest.main()
