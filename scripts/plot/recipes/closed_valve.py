"""The pressure along the channel, and the flow that leaks."""

import numpy

import figures


def draw(run):
    figures.field(run, "valve", window=(1.5, 2.75, 0, 1))
    x = numpy.linspace(0, 4, 400)
    figures.against(run, "pressure", [("x [cm]", "p at mid height [dyn/cm^2]", [
        (x, figures.along(run, (0, 0.5), (4, 0.5))["pressure"], "ifsi", "-")])])
