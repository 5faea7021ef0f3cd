"""Runs a driver in a folder of its own and returns what a user would see."""

import contextlib
import json
import os
import pathlib
import subprocess
import tempfile
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parents[2]


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


def run(case, *options, ranks=1, out=None, config=None, timeout=200):
    """Runs a case with its own configuration (or the file `config`) and the options given."""
    with folder() as scratch:
        out = out or scratch / "out"
        command = [pathlib.Path(os.environ["IFSI_DRIVERS"], case), "--out", out,
                   "--config", config or ROOT / "data" / "cases" / f"{case}.toml", *options]
        if ranks > 1:
            command = [os.environ["IFSI_MPIEXEC"], "-q", "--oversubscribe", "-n", str(ranks), *command]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              timeout=timeout, cwd=ROOT)
        summary = pathlib.Path(out) / "summary.json"
        files = sorted(p.name for p in pathlib.Path(out).iterdir()) if pathlib.Path(out).is_dir() else []
        return Outcome(done.returncode, done.stdout, json.loads(summary.read_text()) if summary.exists() else {}, files)


def settings(**values):
    """--set options; a key is written with '__' for its dot."""
    return [word for key, value in values.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]
