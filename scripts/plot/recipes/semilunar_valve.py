"""Six moments of a beat: the jet in the plane of symmetry, and the leaflets seen from the aorta with their stress."""

import matplotlib
import numpy
from matplotlib import pyplot
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import figures
import triangles
import vtu

SIXTH = numpy.pi / 3
WINDOW = (-1.9, 1.9, -1.0, 5.5)


def turned(points, angle):
    c, s = numpy.cos(angle), numpy.sin(angle)
    return points @ numpy.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])


def without_slivers(points, corners):
    """Triangles but those that a cell has with a plane beside its edge: drawn, they smear."""
    a, b, c = (points[corners[:, k]] for k in range(3))
    return corners[numpy.abs(numpy.cross(b - a, c - a)) > 1e-8]


def half_planes(run, file):
    """The plane y = 0 of the whole valve in parts: (grid, position of the plane in it, side of the axis). A sector
    holds one half of it on its first cut, and the other one, behind the axis, on its second."""
    grid = vtu.read(file)
    if run.parameter("model") != "sector":
        return [(grid, 1e-6, 1)]
    behind = vtu.Grid(turned(grid.points, -SIXTH), grid.cells, grid.point_data)
    return [(grid, 1e-6, 1), (behind, -1e-6, -1)]


def whole_leaflets(run, grid, value):
    """Quadrilaterals (m, 4, 3) of all three leaflets and the mean of a nodal value on each."""
    quads = triangles.surface(grid)
    points, value = grid.points[quads], value[quads].mean(axis=1)
    if run.parameter("model") == "sector":
        both = numpy.concatenate([points, points * [1, -1, 1]])
        points = numpy.concatenate([turned(both.reshape(-1, 3), 2 * k * SIXTH).reshape(both.shape) for k in range(3)])
        value = numpy.tile(value, 6)
    return points, value


def moments(run, n=6):
    """Frames until the valve has shut, evenly."""
    times = [t for t, _ in run.fields("fluid")]
    wanted = numpy.linspace(0, min(times[-1], 0.42), n + 1)[1:] if times else []
    return sorted({figures.fluid_at(run, t) for t in wanted})


def jet(run, axis, frame, top):
    for grid, position, side in half_planes(run, run.fields("fluid")[frame][1]):
        points, corners, data = triangles.section(grid, 1, position)
        points = points[:, [0, 2]] * [side, 1]
        image = axis.tripcolor(points[:, 0], points[:, 1], without_slivers(points, corners),
                               numpy.linalg.norm(data["velocity"], axis=1), shading="gouraud", cmap="viridis", vmin=0,
                               vmax=top, rasterized=True)
    for grid, position, side in half_planes(run, run.fields("solid")[frame][1]):
        cut_leaflets(axis, grid, position, side)
    axis.set(xlim=WINDOW[:2], ylim=WINDOW[2:], aspect="equal", title=f"t = {run.fields('fluid')[frame][0]:.3f} s")
    axis.grid(False)
    return image


def cut_leaflets(axis, grid, position, side):
    if triangles.is_surface(grid):
        figures.add_lines(axis, triangles.curve(grid, 1, position)[..., [0, 2]] * [side, 1])
        return
    points, corners, _ = triangles.section(grid, 1, position)
    points = points[:, [0, 2]] * [side, 1]
    if len(corners):
        figures.add_solid(axis, points, without_slivers(points, corners))


def leaflets(run, axis, frame, top):
    grid = vtu.read(run.fields("solid")[frame][1])
    points, value = whole_leaflets(run, grid, grid.point_data["principal_stress_1"])
    colours = pyplot.get_cmap("inferno")(numpy.clip(value / top, 0, 1))
    axis.add_collection3d(Poly3DCollection(points, facecolors=colours, edgecolors="0.3", linewidths=0.1))
    axis.set(xlim=(-1.2, 1.2), ylim=(-1.2, 1.2), zlim=(0, 1.8))
    axis.set_box_aspect((1, 1, 0.75))
    axis.view_init(elev=55, azim=-60)
    axis.set_axis_off()


def draw(run):
    history = run.table("history")
    if history is not None:
        panels = [("flow [cm^3/s]", "flow", 1), ("orifice area [cm^2]", "goa", 1),
                  ("pressure drop [mmHg]", "pressure_drop", 1333.22)]
        figures.against(run, "curves", [("t [s]", label, [(history["t"], history[column] / unit, "ifsi", "-")])
                                        for label, column, unit in panels])
    frames = moments(run)
    if not frames:
        return
    speed = max(numpy.linalg.norm(vtu.read(run.fields("fluid")[f][1]).point_data["velocity"], axis=1).max()
                for f in frames)
    stress = max(numpy.percentile(vtu.read(run.fields("solid")[f][1]).point_data["principal_stress_1"], 99)
                 for f in frames)
    figure = pyplot.figure(figsize=(2.1 * len(frames), 5.6))
    for k, frame in enumerate(frames):
        axis = figure.add_subplot(2, len(frames), k + 1)
        image = jet(run, axis, frame, speed)
        leaflets(run, figure.add_subplot(2, len(frames), len(frames) + k + 1, projection="3d"), frame, stress)
    figure.colorbar(image, ax=figure.axes[::2], label="speed [cm/s]", fraction=0.012, pad=0.01)
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0, stress), "inferno")
    figure.colorbar(scale, ax=figure.axes[1:2 * len(frames):2], label="principal stress [dyn/cm^2]", fraction=0.012,
                    pad=0.01)
    run.save(figure, "beat")
    pyplot.close(figure)
