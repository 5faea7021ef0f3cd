"""Errors over the mesh size or the time step of a sweep."""

import figures


def draw(run):
    table = run.table("convergence")
    if table is not None and len(table) > 1:
        figures.orders(run, "convergence", table, table.first, ["v_l2", "v_h1", "p_l2"], [1, 2, 3])
