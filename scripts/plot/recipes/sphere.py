"""The velocity of the fall over that of the reference, the flow, and the error over the mesh."""

import numpy

import figures
import run as runs


def draw(run):
    history = run.table("history")
    if history is not None and len(history) > 2:
        table = runs.reference("sphere_rigid_velocity_history.csv")
        t, v = table.columns.values()
        now = t <= history["t"][-1]
        figures.against(run, "velocity", [("t [s]", "downward velocity [cm/s]", [
            (t[now], -v[now], "rigid sphere, axisymmetric Q2-Q1", "k-"),
            (history["t"], -history["v_z"], "ifsi", "o")])])
    if run.parameter("model") == "axisymmetric":
        figures.field(run, "flow", window=(0, 1, 1.7, 3.3))
    sweep = run.table("convergence")
    if sweep is not None and len(sweep) == 3:
        h, error = sweep["h"], numpy.abs(sweep["error"])
        figures.against(run, "error", [("h [cm]", "error of the terminal velocity", [
            (h, error, "ifsi", "o-"), (h, error[0] * (h / h[0]), "order 1", "k:"),
            (h, error[0] * (h / h[0]) ** 2, "order 2", "k--")])], scale="log")
