"""Error over time on exact vortices, cost per unknown over the size of the mesh, drag error over time."""

import figures


def draw(run):
    table = run.table("taylor_green")
    if table is not None:
        figures.pareto(run, "pareto", table, "cpu", "v_rel", ["order", "dt"])
    growth = {name[len("growth_"):]: run.table(name) for name in run.tables() if name.startswith("growth_")}
    curves = [(t["unknowns"], t["us_per_unknown_step"], name, "o-") for name, t in growth.items() if t is not None]
    if curves:
        figures.against(run, "growth", [("unknowns", "CPU per unknown and step [us]", curves)], "log")
    table = run.table("cylinder_2D1")
    if table is not None:
        figures.against(run, "cylinder", [("CPU [s]", "relative error of the drag",
                                           [(table["cpu"], table["cd_error"], "cylinder 2D-1", "o-")])], "log")
