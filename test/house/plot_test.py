"""The plotting program: its reader against files written here, its sections against areas, and its pictures."""

import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy

PLOT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "plot"
sys.path.insert(0, str(PLOT))
import run as runs  # noqa: E402
import triangles  # noqa: E402
import vtu  # noqa: E402


def encode(array, header, block):
    """A compressed appended array as VTK defines it."""
    raw = array.tobytes()
    parts = [zlib.compress(raw[i:i + block]) for i in range(0, len(raw), block)]
    last = len(raw) % block
    return struct.pack("<%d%s" % (3 + len(parts), header), len(parts), block, last, *map(len, parts)) + b"".join(parts)


def write_vtu(path, points, cells, kind, data, header="UInt32", block=64):
    letter = {"UInt32": "I", "UInt64": "Q"}[header]
    names = {"<f8": "Float64", "<f4": "Float32", "<i8": "Int64", "<i4": "Int32", "|u1": "UInt8"}
    appended = b""

    def element(name, array):
        nonlocal appended
        text = (f'<DataArray type="{names[array.dtype.str]}" Name="{name}" format="appended" offset="{len(appended)}"'
                f' NumberOfComponents="{array.shape[1] if array.ndim > 1 else 1}"/>')
        appended += encode(array, letter, block)
        return text

    offsets = numpy.arange(1, len(cells) + 1, dtype="i8") * cells.shape[1]
    text = (f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
            f'header_type="{header}" compressor="vtkZLibDataCompressor"><UnstructuredGrid>'
            f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">'
            f'<PointData>{"".join(element(n, a) for n, a in data.items())}</PointData>'
            f'<Points>{element("Points", points)}</Points><Cells>'
            f'{element("connectivity", cells.ravel().astype("i8"))}{element("offsets", offsets)}'
            f'{element("types", numpy.full(len(cells), kind, "u1"))}</Cells></Piece></UnstructuredGrid>'
            '<AppendedData encoding="raw">_')
    path.write_bytes(text.encode() + appended + b"</AppendedData></VTKFile>")


def plane_quads(n, length=2.0):
    """n x n quadrilaterals on [0, length] x [0, 1]."""
    x, y = numpy.meshgrid(numpy.linspace(0, length, n + 1), numpy.linspace(0, 1, n + 1), indexing="ij")
    points = numpy.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()])
    i, j = (a.ravel() for a in numpy.meshgrid(range(n), range(n), indexing="ij"))
    a = i * (n + 1) + j
    return points, numpy.column_stack([a, a + n + 1, a + n + 2, a + 1])


def area(points, corners):
    a, b, c = (points[corners[:, k]] for k in range(3))
    return 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=-1).sum()


class Reader(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def test_round_trip(self):
        points, cells = plane_quads(4)
        data = {"velocity": numpy.random.default_rng(1).random((25, 3)), "pressure": numpy.arange(25, dtype="f4")}
        for header in ["UInt32", "UInt64"]:
            for block in [64, 80, 1 << 16]:
                write_vtu(self.path / "a.vtu", points, cells, 9, data, header, block)
                grid = vtu.read(self.path / "a.vtu")
                numpy.testing.assert_array_equal(grid.points, points)
                numpy.testing.assert_array_equal(grid.cells[9], cells)
                for name, values in data.items():
                    numpy.testing.assert_array_equal(grid.point_data[name], values)

    def test_pieces_and_series(self):
        points, cells = plane_quads(2)
        for piece in (0, 1):
            write_vtu(self.path / f"a_{piece}.vtu", points + [2.0 * piece, 0, 0], cells, 9, {"p": points[:, 0] + piece})
        (self.path / "a.pvtu").write_text('<VTKFile><PUnstructuredGrid><Piece Source="a_0.vtu"/>'
                                          '<Piece Source="a_1.vtu"/></PUnstructuredGrid></VTKFile>')
        (self.path / "a.pvd").write_text('<VTKFile><Collection><DataSet timestep="2" file="b.vtu"/>'
                                         '<DataSet timestep="1" file="a.pvtu"/></Collection></VTKFile>')
        series = vtu.series(self.path / "a.pvd")
        self.assertEqual([t for t, _ in series], [1.0, 2.0])
        grid = vtu.read(series[0][1])
        self.assertAlmostEqual(area(grid.points, triangles.plane(grid)), 4.0)
        numpy.testing.assert_allclose(grid.point_data["p"][9:], points[:, 0] + 1)

    def test_table(self):
        (self.path / "t.csv").write_text("# source: a book\nt [s],drag [N],kind\n0,1.5,Q1\n1,nan,Q2\n")
        table = runs.read_table(self.path / "t.csv")
        self.assertEqual((table.units, table.comments), ({"t": "s", "drag": "N", "kind": ""}, ["source: a book"]))
        self.assertEqual((list(table["t"]), list(table["kind"]), table["drag"][0]), ([0, 1], ["Q1", "Q2"], 1.5))


class Surfaces(unittest.TestCase):
    def test_two_triquadratic_hexahedra_share_a_face(self):
        one = 0.5 * numpy.array(triangles.HEX27, dtype=float)
        points, index = numpy.unique(numpy.concatenate([one, one + [1, 0, 0]]), axis=0, return_inverse=True)
        quads = triangles.surface(vtu.Grid(points, {29: index.reshape(2, 27)}))
        self.assertEqual(len(quads), 2 * 24 - 8)
        self.assertAlmostEqual(sum(area(points, quads[:, k]) for k in ([0, 1, 2], [0, 2, 3])), 10.0)

    def test_a_hexahedron_of_order_one(self):
        points = 0.5 * numpy.array(triangles.HEX27[:8], dtype=float)
        quads = triangles.surface(vtu.Grid(points, {12: numpy.arange(8)[None]}))
        self.assertAlmostEqual(sum(area(points, quads[:, k]) for k in ([0, 1, 2], [0, 2, 3])), 6.0)


class Membranes(unittest.TestCase):
    """A cell of nine nodes on the cylinder x^2 + z^2 = 4, from z = 0 to 1 and y = 0 to 3."""

    def setUp(self):
        lattice = [(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5), (0.5, 0.5)]
        points = numpy.array([(numpy.sqrt(4 - v ** 2), 3 * u, v) for u, v in lattice])
        self.grid = vtu.Grid(points, {28: numpy.arange(9)[None]})

    def test_it_is_its_own_surface(self):
        self.assertTrue(triangles.is_surface(self.grid))
        quads = self.grid.points[triangles.surface(self.grid)]
        self.assertEqual(quads.shape, (4, 4, 3))
        diagonals = numpy.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1])
        self.assertAlmostEqual(0.5 * numpy.linalg.norm(diagonals, axis=1).sum(), 3 * 2 * numpy.pi / 6, places=1)
        self.assertTrue((diagonals[:, 0] < 0).all() or (diagonals[:, 0] > 0).all())  # one way round

    def test_a_plane_cuts_it_along_a_line(self):
        segments = triangles.curve(self.grid, 1, 0.7)
        numpy.testing.assert_allclose(segments[..., 1], 0.7)
        lengths = numpy.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)
        self.assertAlmostEqual(lengths.sum(), 2 * numpy.pi / 6, places=2)
        self.assertAlmostEqual(segments[..., 2].min(), 0)
        self.assertAlmostEqual(segments[..., 2].max(), 1)
        self.assertEqual(triangles.curve(self.grid, 1, 4.0).shape, (0, 2, 3))


class Triangles(unittest.TestCase):
    # VTK positions of the nodes of each cell type on the unit cell.
    TRIANGLE = [(0, 0), (1, 0), (0, 1), (.5, 0), (.5, .5), (0, .5)]
    QUAD = [(0, 0), (1, 0), (1, 1), (0, 1), (.5, 0), (1, .5), (.5, 1), (0, .5), (.5, .5)]
    TET = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (.5, 0, 0), (.5, .5, 0), (0, .5, 0), (0, 0, .5), (.5, 0, .5),
           (0, .5, .5)]
    WEDGE = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)]

    def cell(self, kind, nodes):
        points = numpy.array([(*node, 0)[:3] for node in nodes], float)
        return vtu.Grid(points, {kind: numpy.arange(len(nodes))[None]}, {"x": points[:, 0] + 2 * points[:, 1]})

    def test_plane_cells_are_covered(self):
        for kind, nodes, expected in [(5, self.TRIANGLE[:3], .5), (22, self.TRIANGLE, .5), (9, self.QUAD[:4], 1),
                                      (23, self.QUAD[:8], 1), (28, self.QUAD, 1)]:
            grid = self.cell(kind, nodes)
            self.assertAlmostEqual(area(grid.points, triangles.plane(grid)), expected)

    def test_sections(self):
        hexes = [tuple(x / 2 for x in position) for position in triangles.HEX27]
        for kind, nodes, expected in [(10, self.TET[:4], .5 * .7 ** 2), (24, self.TET, .5 * .7 ** 2),
                                      (12, hexes[:8], 1), (29, hexes, 1), (13, self.WEDGE, .5)]:
            points, corners, data = triangles.section(self.cell(kind, nodes), 2, 0.3)
            self.assertAlmostEqual(area(points, corners), expected)
            numpy.testing.assert_allclose(points[:, 2], 0.3)
            numpy.testing.assert_allclose(data["x"], points[:, 0] + 2 * points[:, 1], atol=1e-14)

    def test_outline(self):
        points, cells = plane_quads(3)
        self.assertEqual(len(triangles.outline(triangles.pieces({9: cells}, triangles.PLANE))), 12)


class Pictures(unittest.TestCase):
    def plot(self, folder):
        return subprocess.run([sys.executable, PLOT / "plot.py", folder], capture_output=True, text=True, check=False)

    def test_folder_of_a_run(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            (path / "history.csv").write_text("t [s],cd [-],cl [-],dt [s]\n0,1,0,1\n1,2,1,1\n2,2,0,1\n")
            points, cells = plane_quads(8)
            data = {"velocity": numpy.column_stack([points[:, 1], -points[:, 0], 0 * points[:, 0]]),
                    "pressure": points[:, 0]}
            write_vtu(path / "fluid_1.vtu", points, cells, 9, data)
            write_vtu(path / "leaflet_1.vtu", 0.3 * points + [0.5, 0, 0], cells, 9, {"displacement": 0 * points})
            for name in ["fluid", "leaflet"]:
                (path / f"{name}.pvd").write_text(
                    f'<VTKFile><Collection><DataSet timestep="1" file="{name}_1.vtu"/></Collection></VTKFile>')
            done = self.plot(folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            for name in ["history", "field"]:
                self.assertGreater((path / f"{name}.png").stat().st_size, 5000)

    def test_damaged_file_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            (path / "fluid.pvd").write_text(
                '<VTKFile><Collection><DataSet timestep="1" file="gone.vtu"/></Collection></VTKFile>')
            done = self.plot(folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn("gone.vtu", done.stderr)


if __name__ == "__main__":
    unittest.main()
