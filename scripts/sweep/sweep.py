"""Runs a case over a grid of settings: sweep.py FILE BUILD OUT [-j JOBS] [--only NAME]

FILE is TOML with one or more tables [[map]]:

    name = "dt"                      # of the table and the picture
    case = "open_valve"              # driver
    set = { "time.end" = 1.0 }       # settings of every run
    metrics = ["tip_dx_max"]         # to be listed; the first one is judged
    axes = [ ... ]                   # the grid: each axis is a list of points {label, set},
                                     # or {key = "...", values = [...]} for one setting
    reference = { "time.dt" = 1e-3 } # optional: these settings, with all axes named in `judged_along`
    judged_along = [0]               # at their own point and the others at their first, give the right answer
    tolerance = 0.05                 # relative to it; or
    exact = 0.5775                   # the right answer itself

A run is `right`, `off` (finished outside the tolerance), `warned` (off, but its log says why) or `refused` (ended with
an exit code and a reason). OUT/<name>.csv has one row per run, and each run keeps its folder: a second call
continues where the first one stopped.
"""

import argparse
import concurrent.futures
import csv
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXIT_CODES = {1: "configuration", 2: "file", 3: "linear solver", 4: "step control", 5: "invalid state", 6: "stopped"}


def fail(text):
    print(f"ifsi: {text}", file=sys.stderr)
    sys.exit(1)


def points(axis):
    """An axis as a list of (label, settings)."""
    if isinstance(axis, dict):
        return [(f"{axis['key']}={value:g}" if isinstance(value, (int, float)) else f"{axis['key']}={value}",
                 {axis["key"]: value}) for value in axis["values"]]
    return [(point["label"], point["set"]) for point in axis]


class Runner:
    """Runs a driver once per distinct settings; knows the results of earlier calls."""

    def __init__(self, build, out):
        self.build, self.out = build, out

    def folder(self, case, settings):
        name = "_".join(f"{key.split('.')[-1]}-{value}" for key, value in sorted(settings.items()))
        return self.out / "runs" / (case + "_" + name.replace("/", "-"))

    def run(self, case, settings):
        folder = self.folder(case, settings)
        log = folder / "console.txt"  # the program keeps a log.txt of its own there
        if not (folder / "exit").exists():
            folder.mkdir(parents=True, exist_ok=True)
            command = [self.build / "drivers" / case, "--config", ROOT / "data" / "cases" / f"{case}.toml", "--out", folder]
            for key, value in settings.items():
                command += ["--set", f"{key}={str(value).lower() if isinstance(value, bool) else value}"]
            environment = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", **os.environ}
            with open(log, "w") as stream:
                code = subprocess.run(command, stdout=stream, stderr=stream, env=environment, check=False).returncode
            (folder / "exit").write_text(str(code))
        code = int((folder / "exit").read_text())
        lines = log.read_text().splitlines()
        result = {"exit": code, "cuts": sum(line.startswith("step to t") for line in lines),
                  "warning": next((line for line in lines if line.startswith("warning")), ""), "metrics": {}}
        summary = folder / "summary.json"
        if code in (0, 7) and summary.exists():
            result |= json.loads(summary.read_text())
            result["reason"] = ""
        else:
            result["reason"] = EXIT_CODES.get(code, f"exit code {code}") + ": " + (lines[-1] if lines else "")
        return result


def judge(result, metric, right, tolerance):
    """(status, relative error) of a run."""
    if result["reason"]:
        return "refused", None
    value = result["metrics"].get(metric)
    if right is None or value is None:
        return "done", None
    error = abs(value - right) / abs(right)
    if error <= tolerance:
        return "right", error
    return ("warned" if result["warning"] else "off"), error


def sweep(runner, spec, jobs):
    axes = [points(axis) for axis in spec["axes"]]
    base, metrics, case = spec.get("set", {}), spec["metrics"], spec["case"]

    def reference(combination):
        kept = spec.get("judged_along", [])
        settings = dict(base)
        for i, axis in enumerate(axes):
            settings |= (combination[i] if i in kept else axis[0])[1]
        return settings | spec["reference"]

    grid = list(itertools.product(*axes))
    wanted = []
    for combination in grid:
        settings = dict(base)
        for _, change in combination:
            settings |= change
        wanted.append((settings, reference(combination) if "reference" in spec else None))
    distinct = {json.dumps(s, sort_keys=True): s for pair in wanted for s in pair if s is not None}
    results = {}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        tasks = {pool.submit(runner.run, case, settings): key for key, settings in distinct.items()}
        for n, task in enumerate(concurrent.futures.as_completed(tasks), 1):
            results[tasks[task]] = task.result()
            print(f"\r{spec['name']}: {n} of {len(tasks)} runs", end="", file=sys.stderr)
    print(file=sys.stderr)

    rows = []
    for combination, (settings, refined) in zip(grid, wanted):
        result = results[json.dumps(settings, sort_keys=True)]
        right = spec.get("exact")
        if refined is not None:
            right = results[json.dumps(refined, sort_keys=True)]["metrics"].get(metrics[0])
        status, error = judge(result, metrics[0], right, spec.get("tolerance", 0.05))
        row = {f"axis{i}": label for i, (label, _) in enumerate(combination)}
        row |= {"status": status, "error": "" if error is None else f"{error:.3g}", "cuts": result["cuts"]}
        row |= {name: result.get(name, "") for name in ("steps", "newton_total", "gmres_total", "cpu_s", "dofs")}
        row |= {name: result["metrics"].get(name, "") for name in metrics}
        row["reason"] = result["reason"] or result["warning"]
        rows.append(row)
    with open(runner.out / f"{spec['name']}.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--only", help="the map of this name alone")
    parser.add_argument("--cases", action="store_true", help="print the drivers the file needs, and do nothing")
    options = parser.parse_args()
    maps = tomllib.loads(options.file.read_text())["map"]
    if options.cases:
        print(" ".join(sorted({spec["case"] for spec in maps})))
        return
    if options.only:
        names = [spec["name"] for spec in maps]
        maps = [spec for spec in maps if spec["name"] == options.only]
        if not maps:
            fail(f"{options.file.name} has no map '{options.only}'; there are: {' '.join(names)}")
    options.out.mkdir(parents=True, exist_ok=True)
    for spec in maps:
        rows = sweep(Runner(options.build, options.out), spec, options.jobs)
        counts = {status: sum(row["status"] == status for row in rows) for status in ("right", "done", "warned", "off", "refused")}
        print(spec["name"] + ": " + ", ".join(f"{n} {status}" for status, n in counts.items() if n))
        for row in rows:
            print("  " + "  ".join(str(value) for value in row.values()))


if __name__ == "__main__":
    main()
