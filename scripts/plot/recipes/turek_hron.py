"""Forces and the tip over the last periods, and the flow around the flag."""

import figures


def draw(run):
    figures.field(run, "near", window=(0.0, 1.2, 0.0, 0.41))
    history = run.table("history")
    if history is None:
        return
    settle = run.parameter("time.settle") or 0.0
    last = history["t"] >= settle
    curves = [(name, history[name][last]) for name in ("tip_ux", "tip_uy", "drag", "lift") if name in history.columns]
    figures.against(run, "curves", [("t [s]", figures.labelled(name, history.units[name]),
                                     [(history["t"][last], values, name, "-")]) for name, values in curves])
