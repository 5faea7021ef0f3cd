"""The flow near the cylinder."""

import figures


def draw(run):
    figures.field(run, "near", window=(0.3, 0.9, 0.0, 0.41) if run.parameter("problem") == "3D-1Z" else (0, 0.9, 0, 0.41))
