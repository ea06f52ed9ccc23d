"""The curve itself, grabbed and bent."""

from __future__ import annotations

import msgspec

from app.document import words
from app.document.model import Document, Vector
from app.tools.pointer import Hit, Pointer
from app.view_model.bend import Bend
from app.view_model.curve_view import CurveView
from app.view_model.hold import BendWith

_TOLERANCE = 0.05
"""Pixels that the grabbed point may be off, where the parameters answer to the points."""


class BendCurve(msgspec.Struct, frozen=True):
    """Change the data as little as makes the grabbed point follow: Ctrl points only, Alt derivatives only."""

    document: Document
    curve: int
    view: CurveView
    hit: Hit
    start: Vector
    _bends: dict[BendWith, Bend] = msgspec.field(default_factory=dict)

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Bend curve at t = {words.number(self.hit.t)}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys."""
        return bend_keys(self.view)

    def readout_at(self, pointer: Pointer) -> str:
        """Tell where, and what changes."""
        return f"Bend at t = {words.number(self.hit.t)}: {self._using(pointer).value}"

    def document_at(self, pointer: Pointer) -> Document:
        """Let the grabbed point keep its distance to the pointer."""
        at, to = self.start, pointer.position
        target = (self.hit.position[0] + to[0] - at[0], self.hit.position[1] + to[1] - at[1])
        curve = self._grabbed(self._using(pointer)).bent(target, _TOLERANCE / pointer.scale)
        return self.document.with_curve(self.curve, curve)

    def _grabbed(self, using: BendWith) -> Bend:
        if using not in self._bends:
            self._bends[using] = Bend(self.view, self.hit.t, using)
        return self._bends[using]

    def _using(self, pointer: Pointer) -> BendWith:
        if not self.view.source.family.derivatives or pointer.ctrl:
            return BendWith.POINTS
        return BendWith.DERIVATIVES if pointer.alt else BendWith.ALL


def bend_keys(view: CurveView) -> str:
    """Return what modifiers change of a bend."""
    return "Ctrl: points only · Alt: derivatives only" if view.source.family.derivatives else ""
