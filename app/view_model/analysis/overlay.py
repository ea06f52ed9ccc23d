"""The record of an overlay: something that can be drawn over the curve.

To add one: a file in ``overlays`` with a record. Menu, palette, keys, Analysis dock, legend and canvas
read it there.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import msgspec

from ..line_styles import LineStyle
from ..registry import Registry
from .figures import Figure
from .overlay_settings import OverlaySetting, SettingValues

if TYPE_CHECKING:
    from ..curve.curve_view import CurveView
    from .scene import Scene

Drawn = tuple[list[Figure], str]
"""Figures, the first one at the bottom, and what there is to say about them."""

Entry = tuple[LineStyle, str]
"""A style of figures, and what the legend says about it."""


class Group(enum.IntEnum):
    """The subjects of overlays; overlays of a group stand together."""

    SHAPE = 0
    POLYGONS = 1
    ERRORS = 2


class Overlay(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """Something that can be drawn over the curve; compares by identity.

    Attributes
    ----------
    name
        A word in lower case, of which its object names are made.
    text, tip, key, icon, full_name
        Those of its action.
    group, rank
        Its place in the menu and the dock.
    layer
        Those with larger numbers are drawn over the others.
    draw
        Computes figures and words, in every frame of a drag: in some 2 ms, or it has to settle.
    settles
        Whether it is too heavy for a frame, of some curve: drawn once nothing has changed for a moment,
        beside the window.
    settings
        The numbers that it is drawn with; the dock shows them.
    follows_scrub
        Whether the t of the scrub line is shown in it.
    brings_scrub
        Whether a scrub line appears with it.
    legend
        Its entries in the legend, for a curve and the settings.
    finds
        The figures that it may find: explained where they are drawn.
    """

    name: str
    text: str
    tip: str
    group: Group
    rank: int
    layer: int
    draw: Callable[[Scene], Drawn]
    settles: Callable[[CurveView], bool] = lambda _view: False
    key: str = ""
    icon: str = ""
    full_name: str = ""
    settings: tuple[OverlaySetting, ...] = ()
    follows_scrub: bool = False
    brings_scrub: bool = False
    legend: Callable[[CurveView, SettingValues], Sequence[Entry]] = lambda _view, _settings: ()
    finds: Sequence[Entry] = ()

    @property
    def sort_key(self) -> tuple[int, ...]:
        """The key by which records are sorted in menus and panels."""
        return self.group, self.rank

    @property
    def action_name(self) -> str:
        """The object name of its action: overlayComb."""
        return f"overlay{self.name.capitalize()}"


OVERLAYS = Registry(Overlay, f"{__package__}.overlays")
"""All overlays, in the order of the menu."""
