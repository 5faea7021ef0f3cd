"""Draws the tables of a sweep as maps: sweep.py FOLDER. One picture per table of three axes: a panel per point of the
last one, colours for the outcome, in each field the error in per cent and the number of step cuts."""

import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

COLOURS = {"right": "#9ec99e", "done": "#c9d7e8", "warned": "#f3dc8c", "off": "#e08e79", "refused": "#b8b8b8"}


def distinct(rows, key):
    return list(dict.fromkeys(row[key] for row in rows))


def draw(axis, rows):
    columns, lines = distinct(rows, "axis1"), distinct(rows, "axis0")
    for row in rows:
        x, y = columns.index(row["axis1"]), lines.index(row["axis0"])
        axis.add_patch(pyplot.Rectangle((x - 0.5, y - 0.5), 1, 1, color=COLOURS[row["status"]], ec="white", lw=2))
        text = row["reason"].split(":")[0] if row["status"] == "refused" else \
            f"{100 * float(row['error']):.2g} %" if row["error"] else ""
        if row["cuts"] != "0" and row["status"] != "refused":
            text += f"\n{row['cuts']} cuts"
        axis.text(x, y, text, ha="center", va="center", fontsize=6)
    axis.set(xlim=(-0.5, len(columns) - 0.5), ylim=(-0.5, len(lines) - 0.5), xticks=range(len(columns)),
             yticks=range(len(lines)))
    axis.set_xticklabels([label.split("=")[-1] for label in columns], fontsize=7)
    axis.set_yticklabels([label.split("=")[-1] for label in lines], fontsize=7)
    axis.grid(False)
    axis.set_xlabel(columns[0].split("=")[0] if "=" in columns[0] else "", fontsize=7)


def picture(table):
    rows = list(csv.DictReader(table.open()))
    if not rows or "axis1" not in rows[0]:
        return None
    panels = distinct(rows, "axis2") if "axis2" in rows[0] else [None]
    wide = min(4, len(panels))
    high = -(-len(panels) // wide)
    figure, axes = pyplot.subplots(high, wide, squeeze=False, sharex=True, sharey=True,
                                   figsize=(1.2 + 2.3 * wide, 0.6 + 1.9 * high), constrained_layout=True)
    for axis, panel in zip(axes.flat, panels):
        draw(axis, [row for row in rows if panel is None or row["axis2"] == panel])
        axis.set_title(panel or "", fontsize=8)
    labels = distinct(rows, "axis0")
    if "=" in labels[0]:
        axes[0, 0].set_ylabel(labels[0].split("=")[0], fontsize=7)
    # Below the panels: matplotlib 3.6 has no place outside of them.
    legend = axes[-1, -1].legend([pyplot.Rectangle((0, 0), 1, 1, color=c) for c in COLOURS.values()], list(COLOURS),
                                 fontsize=6, loc="upper right", bbox_to_anchor=(1.0, -0.28), ncol=len(COLOURS),
                                 frameon=False)
    legend.set_in_layout(False)
    name = table.with_suffix(".png")
    figure.savefig(name, dpi=130)
    pyplot.close(figure)
    return name


if __name__ == "__main__":
    for csv_file in sorted(pathlib.Path(sys.argv[1]).glob("*.csv")):
        drawn = picture(csv_file)
        if drawn:
            print(f"picture: {drawn}")
