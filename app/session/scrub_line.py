"""The scrub line: the t at which everything shows its values."""

from __future__ import annotations

from collections.abc import Callable

from ..view_model.curve.curve_view import CurveView


class ScrubLine:
    """A place on the curve that is edited; neither saved nor undone.

    Parameters
    ----------
    view
        Returns the view of the curve that is edited.
    changed
        Told of another `t`.

    Attributes
    ----------
    t
        Where it stands, or None.
    """

    def __init__(self, view: Callable[[], CurveView], changed: Callable[[float | None], None]) -> None:
        self._view, self._changed = view, changed
        self.t: float | None = None
        # The place that was asked for: the line stands there as far as the curve goes.
        self._asked: float | None = None

    def set(self, t: float | None) -> None:
        """Move the line to `t`, or put it away (None).

        It stays on the curve that is edited: at the end nearer to `t` where that lies outside, away while
        there is no curve, and at `t` again when there is one that goes as far.
        """
        self._asked, before = t, self.t
        curve = None if t is None else self._view().curve
        if t is None or curve is None:
            self.t = None
        else:
            start, end = curve.domain
            self.t = float(min(max(t, start), end))
        if self.t != before:
            self._changed(self.t)

    def keep(self) -> None:
        """Put the line where it was asked for, as far as the present curve goes."""
        self.set(self._asked)
