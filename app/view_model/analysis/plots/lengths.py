"""The lengths of the derivatives over t: speed, acceleration, jerk and snap."""

from __future__ import annotations

from curvecore.arithmetic import vector_lengths

from ..plot import Plot


def _length_of(order: int, title: str, symbol: str, tip: str) -> Plot:
    """Return the plot of the length of a derivative; sorted before the others, by order."""
    return Plot(
        name=title.lower(),
        text=title,
        tip=tip,
        icon=f"plot-{title.lower()}",
        title=f"{title} {symbol}",
        symbol=symbol,
        rank=9 * order,
        orders=(order,),
        values=lambda sampled: vector_lengths(sampled.derivatives[order]),
    )


SPEED = _length_of(1, "Speed", "|c′|", "Plot the speed |c′| over t, below the basis functions")
ACCELERATION = _length_of(2, "Acceleration", "|c″|", "Plot the size of the acceleration |c″| over t")
JERK = _length_of(3, "Jerk", "|c‴|", "Plot |c‴| over t: how fast the acceleration changes")
SNAP = _length_of(4, "Snap", "|c⁗|", "Plot |c⁗| over t: how fast the jerk changes")
