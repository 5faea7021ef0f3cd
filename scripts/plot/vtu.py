"""Reads what ifsi writes for ParaView: .pvd series, .pvtu and .vtu files with appended raw (zlib) data."""

import pathlib
import re
import xml.etree.ElementTree as ElementTree
import zlib
from dataclasses import dataclass, field

import numpy

DTYPES = {"Float64": "f8", "Float32": "f4", "Int64": "i8", "Int32": "i4", "UInt64": "u8", "UInt32": "u4",
          "UInt8": "u1", "Int8": "i1"}


@dataclass
class Grid:
    """Unstructured grid: points (n, 3), cells by VTK type as (m, k) point numbers, data by name."""
    points: numpy.ndarray
    cells: dict
    point_data: dict = field(default_factory=dict)


def series(path):
    """Pairs (time, file) of a .pvd collection, in order of time."""
    path = pathlib.Path(path)
    sets = ElementTree.parse(path).getroot().iter("DataSet")
    return sorted((float(s.get("timestep", 0)), path.parent / s.get("file")) for s in sets)


def read(path):
    """The grid of a .vtu or .pvtu file."""
    path = pathlib.Path(path)
    if path.suffix == ".pvtu":
        pieces = [p.get("Source") for p in ElementTree.parse(path).getroot().iter("Piece")]
        return merge([read(path.parent / source) for source in pieces])
    return read_piece(path)


def merge(grids):
    """One grid of several; points that several of them hold stay several."""
    offsets = numpy.cumsum([0] + [len(g.points) for g in grids])
    kinds = {kind for g in grids for kind in g.cells}
    cells = {kind: numpy.concatenate([g.cells[kind] + offset for g, offset in zip(grids, offsets) if kind in g.cells])
             for kind in kinds}
    data = {name: numpy.concatenate([g.point_data[name] for g in grids]) for name in grids[0].point_data}
    return Grid(numpy.concatenate([g.points for g in grids]), cells, data)


def read_piece(path):
    content = path.read_bytes()
    tag = re.search(rb'<AppendedData[^>]*encoding="raw"[^>]*>\s*_', content)
    if tag is None:
        raise ValueError(f"{path}: no appended raw data")
    tree = ElementTree.fromstring(content[:tag.start()] + b"</VTKFile>")
    arrays = Arrays(content[tag.end():], tree)
    piece = tree.find("UnstructuredGrid/Piece")
    points = arrays.read(piece.find("Points/DataArray"))
    topology = {a.get("Name"): arrays.read(a) for a in piece.find("Cells")}
    data = piece.find("PointData")
    return Grid(points, by_type(topology["connectivity"], topology["offsets"], topology["types"]),
                {a.get("Name"): arrays.read(a) for a in (data if data is not None else [])})


def by_type(connectivity, offsets, types):
    begins = numpy.concatenate([[0], offsets[:-1]])
    sizes = offsets - begins
    return {int(kind): connectivity[begins[types == kind][:, None] + numpy.arange(sizes[types == kind][0])]
            for kind in numpy.unique(types)}


class Arrays:
    """Decodes the DataArray elements of one file from its appended data."""

    def __init__(self, data, tree):
        self.data = data
        self.order = "<" if tree.get("byte_order", "LittleEndian") == "LittleEndian" else ">"
        self.header = numpy.dtype(self.order + DTYPES[tree.get("header_type", "UInt32")])
        self.compressed = tree.get("compressor") is not None

    def read(self, element):
        values = numpy.frombuffer(self.bytes_at(int(element.get("offset"))), self.order + DTYPES[element.get("type")])
        components = int(element.get("NumberOfComponents", 1))
        return values.reshape(-1, components) if components > 1 else values

    def bytes_at(self, offset):
        width = self.header.itemsize
        if not self.compressed:
            size = int(numpy.frombuffer(self.data, self.header, 1, offset)[0])
            return self.data[offset + width:offset + width + size]
        # number of blocks, size of a block, size of the last one, then the compressed size of each
        blocks = int(numpy.frombuffer(self.data, self.header, 1, offset)[0])
        sizes = numpy.frombuffer(self.data, self.header, blocks, offset + 3 * width).astype(int)
        begins = offset + (3 + blocks) * width + numpy.concatenate([[0], numpy.cumsum(sizes)])
        return b"".join(zlib.decompress(self.data[b:b + s]) for b, s in zip(begins, sizes))
