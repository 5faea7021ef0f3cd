"""Runs a driver in a folder of its own and returns what a user would see."""

import contextlib
import json
import os
import pathlib
import subprocess
import tempfile
import time
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parents[2]
TIMEOUT = float(os.environ["IFSI_TIMEOUT"])  # s, of the whole test: no program of it takes longer


@dataclass
class Outcome:
    code: int
    output: str
    summary: dict
    files: list


@contextlib.contextmanager
def folder():
    with tempfile.TemporaryDirectory(prefix="ifsi-") as name:
        yield pathlib.Path(name)


def command(case, *options, ranks=1, out, config=None):
    """How a case is started with its own configuration (or the file `config`)."""
    words = [pathlib.Path(os.environ["IFSI_DRIVERS"], case), "--out", out,
             "--config", config or ROOT / "data" / "cases" / f"{case}.toml", *options]
    launcher = [os.environ["IFSI_MPIEXEC"], "-q", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
    return launcher + words


def outcome(code, output, out):
    summary = pathlib.Path(out) / "summary.json"
    files = sorted(p.name for p in pathlib.Path(out).iterdir()) if pathlib.Path(out).is_dir() else []
    return Outcome(code, output, json.loads(summary.read_text()) if summary.exists() else {}, files)


def run(case, *options, ranks=1, out=None, config=None):
    """Runs a case to its end."""
    with folder() as scratch:
        out = out or scratch / "out"
        done = subprocess.run(command(case, *options, ranks=ranks, out=out, config=config), stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False, timeout=TIMEOUT, cwd=ROOT)
        return outcome(done.returncode, done.stdout, out)


def run_and_disturb(case, *options, out, disturb):
    """Runs a case, calls disturb(process) after its first steps, and waits for its end."""
    with subprocess.Popen(command(case, *options, out=out), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          cwd=ROOT) as process:
        log, deadline = pathlib.Path(out) / "log.txt", time.monotonic() + TIMEOUT
        while process.poll() is None and not (log.exists() and "\nt " in log.read_text()):
            if time.monotonic() > deadline:
                process.kill()
            time.sleep(0.005)
        disturb(process)
        output, _ = process.communicate(timeout=TIMEOUT)
        return outcome(process.returncode, output, out)


def settings(**values):
    """--set options; a key is written with '__' for its dot."""
    return [word for key, value in values.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]
