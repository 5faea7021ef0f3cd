"""Figures that any case can use: curves over time, curves over a reference, fields, orders, error against cost."""

import matplotlib
import numpy
from matplotlib import pyplot
from matplotlib.collections import LineCollection
from matplotlib.tri import LinearTriInterpolator, Triangulation

import triangles
import vtu

matplotlib.use("Agg")
pyplot.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.2,
                        "figure.constrained_layout.use": True, "axes.prop_cycle": pyplot.cycler(
                            color=["#0b5394", "#cc4125", "#38761d", "#b45f06", "#674ea7", "#45818e", "#000000"])})


def labelled(name, unit):
    return f"{name} [{unit}]" if unit not in ("", "-", "1") else name


# ---- curves ----------------------------------------------------------------------------------------------------

def over_time(run, name="history"):
    """Every column of a table over its first; columns with the same unit share a panel."""
    table = run.table(name)
    if table is None or len(table) < 2:
        return
    groups = {}
    for column in list(table.columns)[1:]:
        groups.setdefault(table.units[column] or column, []).append(column)
    figure, axes = pyplot.subplots(len(groups), 1, sharex=True, squeeze=False, figsize=(7, 1.2 + 1.5 * len(groups)))
    for axis, (unit, columns) in zip(axes[:, 0], groups.items()):
        for column in columns:
            axis.plot(table[table.first], table[column], label=column)
        axis.set_ylabel(unit if len(columns) > 1 else labelled(columns[0], table.units[columns[0]]))
        if len(columns) > 1:
            axis.legend(fontsize=7, ncol=min(4, len(columns)))
        if spans_decades(table, columns):
            axis.set_yscale("log")
        elif numpy.ptp(axis.dataLim.intervaly) < 1e-9 * abs(axis.dataLim.y1):  # constant: show no rounding
            axis.set_ylim(sorted((0.0, 2.0 * axis.dataLim.y1)))
    axes[-1, 0].set_xlabel(labelled(table.first, table.units[table.first]))
    run.save(figure, name)
    pyplot.close(figure)


def spans_decades(table, columns):
    values = numpy.concatenate([table[c] for c in columns])
    return len(values) > 0 and values.min() > 0 and values.max() > 1e4 * values.min()


def against(run, name, panels, scale="linear"):
    """A figure of panels (label of x, label of y, curves); a curve is (x, y, label, format). scale: of both axes."""
    figure, axes = pyplot.subplots(1, len(panels), squeeze=False, figsize=(5 * len(panels), 3.8))
    for axis, (x_label, y_label, curves) in zip(axes[0], panels):
        for x, y, label, form in curves:
            axis.plot(x, y, form, label=label, markersize=4, markerfacecolor="none")
        axis.set(xlabel=x_label, ylabel=y_label, xscale=scale, yscale=scale)
        axis.legend(fontsize=7)
    run.save(figure, name)
    pyplot.close(figure)


def orders(run, name, table, x, errors, order_of):
    """Errors over a step size in double logarithmic scales, with the slope of the finest pair beside each name."""
    figure, axis = pyplot.subplots(figsize=(5, 4))
    for column in errors:
        h, e = table[x], table[column]
        slope = numpy.log(e[-1] / e[-2]) / numpy.log(h[-1] / h[-2]) if len(h) > 1 else numpy.nan
        axis.loglog(h, e, "o-", markersize=4, label=f"{column}: order {slope:.2f}")
    for order in order_of:
        h, e = table[x], max(table[c][0] for c in errors)
        axis.loglog(h, e * (h / h[0]) ** order, "k:", linewidth=0.8)
        axis.annotate(str(order), (h[-1], e * (h[-1] / h[0]) ** order), fontsize=7)
    axis.set_xlabel(labelled(x, table.units[x]))
    axis.set_ylabel("error")
    axis.legend(fontsize=7)
    run.save(figure, name)
    pyplot.close(figure)


def pareto(run, name, table, cost, error, by):
    """Error over cost, a mark for each value of the first of the columns `by`, a colour for each of the second; the
    front that no point beats in both."""
    figure, axis = pyplot.subplots(figsize=(6, 4.5))
    kinds = list(zip(*(table[column] for column in by)))
    first, second = (list(dict.fromkeys(values)) for values in zip(*kinds))
    for kind in dict.fromkeys(kinds):
        mine = numpy.array([k == kind for k in kinds])
        label = ", ".join(f"{column} {value:g}" for column, value in zip(by, kind))
        axis.loglog(table[cost][mine], table[error][mine], "os^Dv"[first.index(kind[0]) % 5], markersize=4,
                    color=f"C{second.index(kind[1]) % 10}", label=label)
    front = non_dominated(table[cost], table[error])
    axis.loglog(table[cost][front], table[error][front], color="0.6", linewidth=5, alpha=0.4, zorder=0, label="best")
    axis.set_xlabel(labelled(cost, table.units[cost]))
    axis.set_ylabel(labelled(error, table.units[error]))
    axis.legend(fontsize=7)
    run.save(figure, name)
    pyplot.close(figure)


def non_dominated(cost, error):
    """Indices of the points that no other point beats in both, by rising cost."""
    front = []
    for i in numpy.lexsort((error, cost)):
        if not front or error[i] < error[front[-1]]:
            front.append(i)
    return front


# ---- fields ----------------------------------------------------------------------------------------------------

def plane_fields(grid):
    """Points (n, 2), triangles and data of a plane grid, or of the middle section of one in space."""
    corners = triangles.plane(grid)
    if corners is not None and numpy.ptp(grid.points[:, 2]) == 0:
        return grid.points[:, :2], corners, grid.point_data
    thin, middle = middle_plane(grid)
    points, corners, data = triangles.section(grid, thin, middle)
    return numpy.delete(points, thin, axis=1), corners, data


def middle_plane(grid):
    """The axis along which a grid in space is thinnest, and the middle of it there."""
    thin = int(numpy.argmin(numpy.ptp(grid.points, axis=0)))
    return thin, 0.5 * (grid.points[:, thin].min() + grid.points[:, thin].max())


def scalars(data):
    """What to colour: the speed of a velocity, and the pressure."""
    found = {}
    if "velocity" in data:
        found["speed"] = numpy.linalg.norm(data["velocity"], axis=1)
    if "pressure" in data:
        found["pressure"] = data["pressure"]
    return found


def fluid_at(run, time=None):
    """Number of the frame of the fluid nearest to a time (the last unless told), None without output."""
    series = run.fields("fluid")
    if not series:
        return None
    return len(series) - 1 if time is None else int(numpy.argmin([abs(t - time) for t, _ in series]))


def field(run, name="field", time=None, window=None, streamlines=False):
    """Speed and pressure at one time (the last unless told), the solids drawn over them.
    window: (x min, x max, y min, y max) in the plane of the picture."""
    frame = fluid_at(run, time)
    if frame is None:
        return
    series = run.fields("fluid")
    points, corners, data = plane_fields(vtu.read(series[frame][1]))
    solids = [vtu.read(run.fields(solid)[frame][1]) for solid in run.solids() if len(run.fields(solid)) > frame]
    window = window or (*extent(points[:, 0]), *extent(points[:, 1]))
    values = scalars(data)
    figure, axes = panels(len(values), window)
    for axis, (label, value) in zip(axes, values.items()):
        colour(figure, axis, Triangulation(points[:, 0], points[:, 1], corners), value, label, window)
        if streamlines and label == "speed":
            add_streamlines(axis, points, corners, data["velocity"], window)
        for solid in solids:
            draw_solid(axis, solid)
    axes[0].set_title(run.case + (f", t = {series[frame][0]:.6g}" if len(series) > 1 else ""), fontsize=10)
    run.save(figure, name)
    pyplot.close(figure)


def along(run, start, end, n=400):
    """Fields of the last frame of a plane flow at n positions between two points: {name: values}."""
    points, corners, data = plane_fields(vtu.read(run.fields("fluid")[fluid_at(run)][1]))
    mesh = Triangulation(points[:, 0], points[:, 1], corners)
    x, y = (numpy.linspace(a, b, n) for a, b in zip(start, end))
    found = {"velocity_x": data["velocity"][:, 0], "velocity_y": data["velocity"][:, 1], "pressure": data["pressure"]}
    return {name: LinearTriInterpolator(mesh, values)(x, y) for name, values in found.items()}


def extent(x):
    return x.min(), x.max()


def panels(n, window):
    """n axes for pictures of this window: below each other when it is wide, side by side when it is not."""
    ratio = (window[3] - window[2]) / (window[1] - window[0])
    rows, columns = (n, 1) if ratio < 0.7 else (1, n)
    width = 9.0 / columns
    figure, axes = pyplot.subplots(rows, columns, squeeze=False,
                                   figsize=(9.0, rows * (max(0.9, min(8.0, 0.85 * ratio * width)) + 0.35)))
    return figure, axes.ravel()


def colour(figure, axis, triangulation, value, label, window):
    # Peaks at corners would leave the rest without colour; where pressure is signed, white is zero.
    low, high = (0.0, numpy.percentile(value, 99.8)) if label == "speed" else numpy.percentile(value, [0.5, 99.5])
    signed = min(-low, high) > 0.25 * max(-low, high)
    low, high = (-max(-low, high), max(-low, high)) if signed else (low, max(high, low + 1e-300))
    image = axis.tripcolor(triangulation, value, shading="gouraud", rasterized=True, vmin=low, vmax=high,
                           cmap="RdBu_r" if signed else "viridis" if label == "speed" else "cividis")
    axis.set_aspect("equal")
    axis.grid(False)
    axis.set_xlim(window[0], window[1])
    axis.set_ylim(window[2], window[3])
    ratio = (window[3] - window[2]) / (window[1] - window[0])
    fraction = max(0.015, 0.046 * ratio)
    figure.colorbar(image, ax=axis, label=label, fraction=fraction, pad=0.01, aspect=ratio / fraction)


def add_streamlines(axis, points, corners, velocity, window, n=240):
    ratio = (window[3] - window[2]) / (window[1] - window[0])
    x = numpy.linspace(window[0], window[1], n)
    y = numpy.linspace(window[2], window[3], max(20, int(n * ratio)))
    mesh = Triangulation(points[:, 0], points[:, 1], corners)
    u, v = (LinearTriInterpolator(mesh, velocity[:, k])(*numpy.meshgrid(x, y)) for k in (0, 1))
    axis.streamplot(x, y, u, v, color="white", linewidth=0.4, arrowsize=0.5, density=1.4)


def draw_solid(axis, grid):
    """A plane solid, or the middle section of one in space, membranes as lines."""
    if triangles.is_surface(grid) and numpy.ptp(grid.points[:, 2]) > 0:
        thin, middle = middle_plane(grid)
        add_lines(axis, numpy.delete(triangles.curve(grid, thin, middle), thin, axis=2))
    else:
        add_solid(axis, *plane_fields(grid)[:2])


def add_lines(axis, segments):
    axis.add_collection(LineCollection(segments, colors="white", linewidths=1.2))


def add_solid(axis, points, corners):
    axis.tripcolor(Triangulation(points[:, 0], points[:, 1], corners), numpy.zeros(len(points)), cmap="Greys", vmin=-1,
                   vmax=1, rasterized=True)
    edges = points[triangles.outline(corners)]
    line = numpy.concatenate([edges, numpy.full((len(edges), 1, 2), numpy.nan)], axis=1).reshape(-1, 2)
    axis.plot(line[:, 0], line[:, 1], color="black", linewidth=0.8)
