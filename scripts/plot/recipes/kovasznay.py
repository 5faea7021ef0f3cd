"""Streamlines, and errors over the mesh size of a sweep."""

import figures
from recipes import taylor_green


def draw(run):
    figures.field(run, "streamlines", streamlines=True)
    taylor_green.draw(run)
