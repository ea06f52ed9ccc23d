"""Selecting with a rubber band: points of the curves that are edited, or curves where none is."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from curvecore.arrays import FloatArray

from ..document.group_edits import pressed_curves
from ..document.model import Vector
from ..document.point_group import group_points
from ..view_model.curve.curve_view import CurveView
from . import hints
from .curve_picker import chosen_curves
from .gesture import CANCELLED, THRESHOLD
from .tool import OldGesture, ToolEvent

_KEYS = "Shift: add to what was selected"


class Band(OldGesture):
    """Rubber band: selects what is inside, live; with Shift held, adds to what was selected before.

    Attributes
    ----------
    band
        Two opposite corners of the band; None until the pointer has travelled far enough for a drag.
    """

    def __init__(
        self, event: ToolEvent, on_click: Callable[[ToolEvent], object], *, is_on_curve: bool = False
    ) -> None:
        self._press, self._on_click, self._is_on_curve = event.pointer, on_click, is_on_curve
        self._before = event.session.selected.choice
        self.band: tuple[Vector, Vector] | None = None

    def move(self, event: ToolEvent) -> None:
        """Follow the pointer."""
        pointer = event.pointer
        if self.band is None and math.dist(pointer.pixel, self._press.pixel) < THRESHOLD:
            return
        self.band = (self._press.position, pointer.position)
        self._show(event, np.min(self.band, axis=0), np.max(self.band, axis=0))

    def release(self, event: ToolEvent) -> None:
        """End; a click beside everything deselects, with Shift it leaves the selection.

        With nothing to deselect, and where the press is on a curve, `on_click` is called.
        """
        self.move(event)
        if self.band is not None:
            self._take(event)
        elif self._is_on_curve:
            self._on_click(event)
        elif not event.pointer.shift:
            self._click(event)

    def cancel(self, event: ToolEvent) -> None:
        """Bring back what was selected before."""
        event.session.selected.restore(self._before)
        if self.band is not None:
            event.session.say(CANCELLED)

    def progress(self, event: ToolEvent) -> str:
        """Tell what is selected; nothing before there is a band."""
        return f"{self._words(event)} · Escape cancels" if self.band is not None else ""

    # What it selects

    def _show(self, event: ToolEvent, low: FloatArray, high: FloatArray) -> None:
        """Select what the band takes, while it is drawn."""
        raise NotImplementedError

    def _take(self, event: ToolEvent) -> None:
        """Leave it selected: the band has ended."""
        raise NotImplementedError

    def _click(self, event: ToolEvent) -> None:
        raise NotImplementedError

    def _words(self, event: ToolEvent) -> str:
        raise NotImplementedError


class Marquee(Band):
    """Rubber band that selects points of all curves that are edited."""

    def _show(self, event: ToolEvent, low: FloatArray, high: FloatArray) -> None:
        session = event.session
        inside = group_points(
            (curve, _points_inside(session.views[curve], low, high)) for curve in session.selected.edited
        )
        session.selected.show_group(self._before.points.joined(inside) if event.pointer.shift else inside)

    def _take(self, event: ToolEvent) -> None:
        event.session.selected.set_group(event.session.selected.group)

    def _click(self, event: ToolEvent) -> None:
        if self._before.points.parts:
            event.session.selected.set_points([])
        else:
            self._on_click(event)

    def _words(self, event: ToolEvent) -> str:
        return f"{hints.selected(event.session.selected.group)} · {_KEYS}"


def _points_inside(view: CurveView, low: FloatArray, high: FloatArray) -> frozenset[int]:
    points = view.points
    return frozenset(np.flatnonzero(np.all((points >= low) & (points <= high), axis=1)).tolist())


class CurveMarquee(Band):
    """Rubber band while no curve is edited: chooses the visible, free curves that lie wholly inside.

    Shapes and groups are taken whole, or not.
    """

    def _show(self, event: ToolEvent, low: FloatArray, high: FloatArray) -> None:
        before = self._before.chosen if event.pointer.shift else frozenset()
        event.session.selected.show_choice(before | self._inside(event, low, high))

    def _inside(self, event: ToolEvent, low: FloatArray, high: FloatArray) -> frozenset[int]:
        views, document = event.session.views, event.session.document
        free = {place for place, view in enumerate(views) if _is_free(view)}
        taken = {place for place in free if _is_inside(views[place], low, high)}
        found: set[int] = set()
        for place in taken:
            if place not in found:
                meant = pressed_curves(document, place, self._before) & free
                found |= meant if meant <= taken else set()
        return frozenset(found)

    def _take(self, event: ToolEvent) -> None:
        event.session.selected.choose(event.session.selected.chosen)

    def _click(self, event: ToolEvent) -> None:
        self._on_click(event)

    def _words(self, event: ToolEvent) -> str:
        return f"{chosen_curves(event.session)} · {_KEYS}"


def _is_free(view: CurveView) -> bool:
    return view.source.is_selectable and view.has_curve


def _is_inside(view: CurveView, low: FloatArray, high: FloatArray) -> bool:
    """Whether a curve lies inside a box."""
    return bool(np.all(view.polyline.min(axis=0) >= low) and np.all(view.polyline.max(axis=0) <= high))
