"""The pressure through the centre beside the exact one, and errors over the mesh size of a sweep."""

import numpy

import figures
from recipes import taylor_green


def exact_pressure(r, radius=0.25, width=0.0625, mu=1.0):
    outside = -0.5 * numpy.pi * mu * width * (2 * radius + width)
    return outside + mu * numpy.log((radius + width) / numpy.clip(r, radius, radius + width))


def draw(run):
    x = numpy.linspace(0, 1, 400)
    figures.against(run, "pressure", [("x", "p at y = 0.5", [
        (x, figures.along(run, (0, 0.5), (1, 0.5))["pressure"], "ifsi", "-"),
        (x, exact_pressure(abs(x - 0.5)), "exact", "k--")])])
    taylor_green.draw(run)
