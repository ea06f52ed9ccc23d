"""How long the derivatives are: speed, acceleration and jerk."""

from __future__ import annotations

from app.view_model.analysis.plot import Plot, Sampled
from curvecore.arrays import FloatArray
from curvecore.vectors import vector_lengths


def _length(sampled: Sampled, order: int) -> FloatArray:
    return vector_lengths(sampled.derivatives[order])


SPEED = Plot(
    name="speed",
    text="Speed",
    tip="Plot the speed |c′| over t, below the basis functions",
    icon="plot-speed",
    title="Speed |c′|",
    symbol="|c′|",
    place=10,
    orders=(1,),
    values=lambda sampled: _length(sampled, 1),
)
ACCELERATION = Plot(
    name="acceleration",
    text="Acceleration",
    tip="Plot the size of the acceleration |c″| over t",
    icon="plot-acceleration",
    title="Acceleration |c″|",
    symbol="|c″|",
    place=20,
    orders=(2,),
    values=lambda sampled: _length(sampled, 2),
)
JERK = Plot(
    name="jerk",
    text="Jerk",
    tip="Plot |c‴| over t: how fast the acceleration changes",
    icon="plot-jerk",
    title="Jerk |c‴|",
    symbol="|c‴|",
    place=30,
    orders=(3,),
    values=lambda sampled: _length(sampled, 3),
)
