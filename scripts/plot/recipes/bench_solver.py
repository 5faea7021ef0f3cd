"""Iterations over the number of unknowns, for every flow of the survey."""

import figures


def draw(run):
    table = run.table("solver")
    if table is None:
        return
    panels = []
    for dim in (2, 3):
        curves = []
        for key in sorted(set(zip(table["enclosed"], table["Re"], table["CFL"]))):
            mine = (table["dim"] == dim) & (table["enclosed"] == key[0]) & (table["Re"] == key[1]) & (
                table["CFL"] == key[2])
            if mine.any():
                label = f"{'enclosed' if key[0] else 'open'}, Re {key[1]:g}, CFL {key[2]:g}"
                curves.append((table["unknowns"][mine], table["iterations"][mine], label, "o-"))
        if curves:
            panels.append((f"unknowns ({dim}D)", "iterations", curves))
    figures.against(run, "iterations", panels, "log")
