"""Streamlines, and the two profiles through the middle beside the table of Ghia et al."""

import numpy

import figures


def draw(run):
    figures.field(run, "streamlines", streamlines=True)
    panels = []
    for name, label, component, end in [("u", "y", "x", (0.5, 1)), ("v", "x", "y", (1, 0.5))]:
        table = run.table(f"profile_{name}")
        if table is not None:
            line = figures.along(run, (0.5, 0) if name == "u" else (0, 0.5), end)[f"velocity_{component}"]
            panels.append((label, name, [(numpy.linspace(0, 1, len(line)), line, "ifsi", "-"),
                                         (table["s"], table["ghia"], "Ghia et al. 1982", "o")]))
    if panels:
        figures.against(run, "profiles", panels)
