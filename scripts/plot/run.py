"""The folder of a finished run: its tables, fields and summary."""

import csv
import json
import pathlib
import re
from dataclasses import dataclass

import numpy

import vtu

ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclass
class Table:
    """Columns by name, with units beside; comment lines of the file are kept."""
    columns: dict
    units: dict
    comments: list

    @property
    def first(self):
        return next(iter(self.columns))

    def __getitem__(self, name):
        return self.columns[name]

    def __contains__(self, name):
        return name in self.columns

    def __len__(self):
        return len(self.columns[self.first])


def read_table(path):
    """A CSV file with one line of names, 'name [unit]' or 'name', after any lines that start with '#'."""
    lines = pathlib.Path(path).read_text().splitlines()
    comments = [line.lstrip("# ") for line in lines if line.startswith("#")]
    rows = [row for row in csv.reader(line for line in lines if not line.startswith("#")) if row]
    heads = [re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", head).groups() for head in rows[0]]
    columns = zip(*(row for row in rows[1:] if len(row) == len(heads))) if len(rows) > 1 else [()] * len(heads)
    return Table({name: numpy.array([number(x) for x in column]) for (name, _), column in zip(heads, columns)},
                 {name: unit or "" for name, unit in heads}, comments)


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def reference(name):
    """A reference curve of data/reference."""
    return read_table(ROOT / "data" / "reference" / name)


class Run:
    """What lies in an output folder. Pictures are saved there as PNG."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        summary = self.folder / "summary.json"
        self.summary = json.loads(summary.read_text()) if summary.exists() else {}
        self.case = self.summary.get("case", self.folder.name)
        self.pictures = []

    def parameter(self, key, default=None):
        return self.summary.get("parameters", {}).get(key, default)

    def table(self, name):
        """The table `name`.csv, or None when it is not there or has no rows."""
        path = self.folder / f"{name}.csv"
        table = read_table(path) if path.exists() else None
        return table if table is not None and len(table) else None

    def tables(self):
        return sorted(path.stem for path in self.folder.glob("*.csv"))

    def fields(self, name):
        """Pairs (time, file) of the series `name`.pvd."""
        path = self.folder / f"{name}.pvd"
        return vtu.series(path) if path.exists() else []

    def solids(self):
        """Names of the series that are not the fluid."""
        return sorted(path.stem for path in self.folder.glob("*.pvd") if path.stem != "fluid")

    def save(self, figure, name):
        path = self.folder / f"{name}.png"
        figure.savefig(path, dpi=130, bbox_inches="tight")
        self.pictures.append(path)
