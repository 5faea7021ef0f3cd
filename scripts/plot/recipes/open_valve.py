"""The tip of the top leaflet over the published curves, and the flow around the leaflets at its peak."""

import figures
import run as runs

CURVES = [("ale", "boundary-fitted ALE, Kamensky et al. 2015", "k."), ("kadapa", "Kadapa et al. 2016", "C3."),
          ("m2", "Black et al., M2", "C2."), ("m3", "Black et al., M3", "C1.")]


def draw(run):
    history = run.table("history")
    if history is None:
        return
    panels = []
    for axis in ("x", "y"):
        curves = [(history["t"], history[f"tip_d{axis}"], "ifsi", "-")]
        for name, label, form in CURVES:
            table = runs.reference(f"open_valve_tip_d{axis}_{name}.csv")
            x, y = table.columns.values()
            now = x <= history["t"][-1]
            curves.append((x[now], y[now], label, form))
        panels.append(("t [s]", f"tip d{axis} [cm]", curves))
    figures.against(run, "tip", panels)
    peak = history["t"][history["tip_dx"].argmax()]
    figures.field(run, "peak", time=peak, window=(1, 5, 0.805 if run.parameter("symmetry") else 0, 1.61))
