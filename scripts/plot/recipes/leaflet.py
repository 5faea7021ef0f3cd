"""The path of the tip, and the flow at its two ends."""

import figures


def draw(run):
    history = run.table("history")
    if history is None:
        return
    figures.against(run, "tip", [("t [s]", "tip displacement [m]", [(history["t"], history["tip_dx"], "along", "-"),
                                                                    (history["t"], history["tip_dy"], "across", "-")]),
                                 ("along [m]", "across [m]", [(history["tip_dx"], history["tip_dy"], "tip", "-")])])
    for name, at in [("forward", history["tip_dx"].argmax()), ("backward", history["tip_dx"].argmin())]:
        figures.field(run, name, time=history["t"][at])
