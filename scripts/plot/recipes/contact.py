"""The solids where they are closest, and when the run ends."""

import figures


def draw(run):
    history = run.table("history")
    if history is None:
        return
    window = (0.7, 1.9, 0.5 if run.parameter("symmetry") else 0, 1) if run.parameter("scene") == "valve" else (0, 1, 0, 1)
    worst = history["t"][history["inside"].argmax() if history["inside"].max() > 0 else history["gap"].argmin()]
    figures.field(run, "closest", time=worst, window=window)
    figures.field(run, "end", window=window)
