"""The record of a plot over t.

To add one: a file in ``plots`` with a record. Menu, palette, the buttons of the plots and the plots
themselves read it there.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ..registry import Registry
from .plot_lines import PlotData, Scale

if TYPE_CHECKING:
    from ..curve.curve_view import CurveView


class Sampled(msgspec.Struct, frozen=True, eq=False):
    """A current curve where it is plotted.

    Attributes
    ----------
    t
        Ascending parameters (m,).
    derivatives
        Derivatives (m, 2) there, by their order: those that the plots asked for.
    lebesgue_constant
        The largest factor by which errors of its points grow.
    """

    view: CurveView
    t: FloatArray
    derivatives: dict[int, FloatArray]
    lebesgue_constant: float = 1.0


class Plot(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """Something that can be plotted over t; compares by identity.

    Attributes
    ----------
    name
        A word in lower case, of which its object names are made.
    text, tip, icon
        Those of its action.
    title, symbol
        The words beside the plot, and before its value.
    rank
        The key by which records are sorted in menus and panels.
    orders
        Orders of the derivatives that it needs.
    values
        Computes its values (m,), each from the view and its own t alone: the t are those in sight, or the one
        of the scrub line. What adds up along the curve begins at the start of its domain.
    errors
        Bounds of what rounding may put the values off, where that matters.
    follows_points
        Whether it changes where points move and parameters stay.
    finish
        Says which values are worth seeing, marks some, adds a note.
    """

    name: str
    text: str
    tip: str
    title: str
    symbol: str
    rank: int
    values: Callable[[Sampled], FloatArray]
    icon: str = ""
    orders: tuple[int, ...] = ()
    scale: Scale = Scale.LINEAR
    errors: Callable[[Sampled], FloatArray] = lambda sampled: np.zeros(len(sampled.t))
    follows_points: bool = True
    finish: Callable[[PlotData, Sampled], PlotData] = lambda plot, _sampled: plot

    @property
    def sort_key(self) -> tuple[int, ...]:
        """The key by which records are sorted in menus and panels."""
        return (self.rank,)

    @property
    def action_name(self) -> str:
        """The object name of its action: plotSpeed."""
        return f"plot{self.name.capitalize()}"


PLOTS = Registry(Plot, f"{__package__}.plots")
"""All plots over t, in the order in which they stand below each other."""
