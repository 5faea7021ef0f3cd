"""Draws the pictures of a run: plot.py FOLDER. They lie in the folder as PNG files.

Every run gets its tables over time and its last fields; scripts/plot/recipes/<case>.py adds what is particular.
"""

import importlib
import pathlib
import sys


def main():
    folder = pathlib.Path(sys.argv[1])
    try:
        import figures
        import run as runs
    except ModuleNotFoundError as missing:
        print(f"ifsi: no pictures, since the Debian package python3-{missing.name} is missing", file=sys.stderr)
        return 0
    run = runs.Run(folder)
    steps = [lambda: figures.over_time(run), lambda: figures.field(run)]
    if (pathlib.Path(__file__).parent / "recipes" / f"{run.case}.py").exists():
        steps.append(lambda: importlib.import_module(f"recipes.{run.case}").draw(run))
    failures = 0
    for step in steps:
        try:
            step()
        except Exception as error:  # a picture that fails does not cost the others, nor the run
            print(f"ifsi: a picture failed: {type(error).__name__}: {error}", file=sys.stderr)
            failures += 1
    for picture in run.pictures:
        print(f"picture: {picture}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
