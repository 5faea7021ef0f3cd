"""Triangles to colour: plane cells cut into triangles, and plane sections through cells in space."""

import itertools

import numpy

# VTK node numbers of the pieces of each plane cell type: 5, 9 of order one; 22, 28 of order two; 23 has no centre.
PLANE = {
    5: [(0, 1, 2)],
    9: [(0, 1, 2), (0, 2, 3)],
    22: [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)],
    23: [(0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (4, 5, 7), (5, 6, 7)],
    28: [(0, 4, 8), (0, 8, 7), (4, 1, 5), (4, 5, 8), (8, 5, 2), (8, 2, 6), (7, 8, 6), (7, 6, 3)],
}
HEX = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
# Lattice positions of the 27 nodes of a triquadratic hexahedron.
HEX27 = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2), (1, 0, 0), (2, 1, 0),
         (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2), (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1),
         (0, 1, 1), (2, 1, 1), (1, 0, 1), (1, 2, 1), (1, 1, 0), (1, 1, 2), (1, 1, 1)]


def eighths():
    """Tetrahedra of the eight small hexahedra of a triquadratic one."""
    node = {position: number for number, position in enumerate(HEX27)}
    for x, y, z in itertools.product((0, 1), repeat=3):
        corner = [node[(x + a, y + b, z + c)] for a, b, c in [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                                                              (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]]
        yield from (tuple(corner[i] for i in tet) for tet in HEX)


SPACE = {
    10: [(0, 1, 2, 3)],
    12: HEX,
    13: [(0, 1, 2, 3), (1, 2, 3, 4), (2, 3, 4, 5)],
    24: [(0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3), (4, 8, 7, 6), (4, 5, 8, 6), (9, 7, 8, 6), (9, 8, 5, 6)],
    29: list(eighths()),
}


def pieces(cells, table):
    """Simplices (m, k) of all cells whose type the table knows."""
    parts = [connectivity[:, simplex] for kind, connectivity in cells.items() for simplex in table.get(kind, [])]
    return numpy.concatenate(parts) if parts else None


def plane(grid):
    """Triangles of a plane grid as point numbers (m, 3); None when the grid has no plane cells."""
    return pieces(grid.cells, PLANE)


def section(grid, axis, position):
    """Cut by the plane x_axis = position: points (n, 3), triangles (m, 3), data by name."""
    tets = pieces(grid.cells, SPACE)
    height = grid.points[:, axis] - position
    above = height[tets] > 0
    triangles, ends = [], []
    for pattern in itertools.product((False, True), repeat=4):
        here = tets[(above == pattern).all(axis=1)]
        edges = [e for e in itertools.combinations(range(4), 2) if pattern[e[0]] != pattern[e[1]]]
        if len(edges) == 4:  # opposite edges share no corner: go round
            edges = [edges[0], edges[1], edges[3], edges[2]]
        for corners in [(0, 1, 2), (0, 2, 3)][:max(0, len(edges) - 2)]:
            triangles.append(numpy.arange(3 * len(here)).reshape(-1, 3) + sum(len(e) for e in ends))
            ends.append(here[:, [edges[c] for c in corners]].reshape(-1, 2))
    ends = numpy.concatenate(ends) if ends else numpy.empty((0, 2), int)
    weight = height[ends[:, 0]] / (height[ends[:, 0]] - height[ends[:, 1]])

    def interpolate(values):
        w = weight.reshape(-1, *[1] * (values.ndim - 1))
        return (1 - w) * values[ends[:, 0]] + w * values[ends[:, 1]]

    return (interpolate(grid.points), numpy.concatenate(triangles) if triangles else numpy.empty((0, 3), int),
            {name: interpolate(values) for name, values in grid.point_data.items()})


def curve(grid, axis, position):
    """Where the plane x_axis = position cuts a surface: line segments (m, 2, 3)."""
    corners = plane(grid)
    height = grid.points[:, axis] - position
    above = height[corners] > 0
    segments = []
    for single in range(3):  # the corner that lies on a side of its own
        a, b, c = single, (single + 1) % 3, (single + 2) % 3
        here = corners[(above[:, a] != above[:, b]) & (above[:, a] != above[:, c])]
        ends = []
        for other in (b, c):
            h, h_other = height[here[:, a], None], height[here[:, other], None]
            ends.append((h * grid.points[here[:, other]] - h_other * grid.points[here[:, a]]) / (h - h_other))
        segments.append(numpy.stack(ends, axis=1))
    return numpy.concatenate(segments)


# Faces of a hexahedron as cycles of its corners; HEX27 finds what lies between them.
HEX_FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


def face_quads(kind):
    """Point numbers within a hexahedron (VTK type 12 or 29) of the quadrilaterals that make up its faces."""
    if kind == 12:
        return HEX_FACES
    node = {position: number for number, position in enumerate(HEX27)}

    def middle(*corners):
        return node[tuple(int(x) for x in numpy.mean([HEX27[c] for c in corners], axis=0))]

    return [(face[k], middle(face[k], face[(k + 1) % 4]), middle(*face), middle(face[k - 1], face[k]))
            for face in HEX_FACES for k in range(4)]


# Quadrilaterals of a cell of a surface.
QUADS = {9: [(0, 1, 2, 3)], 28: [(0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3)]}


def is_surface(grid):
    return all(kind in PLANE for kind in grid.cells)


def surface(grid):
    """Quadrilaterals (m, 4) on the surface of a grid of hexahedra, or of a grid that is one."""
    if is_surface(grid):
        return pieces(grid.cells, QUADS)
    quads = numpy.concatenate([connectivity[:, quad] for kind, connectivity in grid.cells.items() if kind in (12, 29)
                               for quad in face_quads(kind)])
    _, first, counts = numpy.unique(numpy.sort(quads, axis=1), axis=0, return_index=True, return_counts=True)
    return quads[first[counts == 1]]


def outline(triangles):
    """Edges (m, 2) that belong to one triangle only."""
    edges = numpy.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    unique, counts = numpy.unique(edges, axis=0, return_counts=True)
    return unique[counts == 1]
