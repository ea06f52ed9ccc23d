"""The tangents at the selected points: smooth, corner, or left to the rules."""

from __future__ import annotations

from collections.abc import Callable

from app.commands.parts import Handlers, Parts
from app.document import edits
from app.document.edits import EditError
from app.document.model import Document, Vector
from app.panels.words import count_of
from app.view_model.curve_view import CurveView

Edit = Callable[[Document, int, CurveView, int], Document]


class TangentCommands:
    """The Tangent menu."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._session = parts.session

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {
            "tangentSmooth": lambda: self._apply("Smooth", _smooth),
            "tangentCorner": lambda: self._apply("Corner at", _corner),
            "tangentEstimated": lambda: self._apply("Estimate", _estimated),
        }

    def render(self, view: CurveView) -> None:
        """Enable the actions where there are points with tangents."""
        usable = bool(self._session.selection) and view.source.family.derivatives > 0 and view.is_current
        for name in ("tangentSmooth", "tangentCorner", "tangentEstimated"):
            self._parts.actions[name].setEnabled(usable)

    def _apply(self, verb: str, edit: Edit) -> None:
        session, chosen = self._session, sorted(self._session.selection)
        view, curve = session.active_view, session.active_index
        if not chosen:
            return
        what = f"point {chosen[0]}" if len(chosen) == 1 else count_of(len(chosen), "point")

        def changed() -> Document:
            document = session.document
            for index in chosen:
                document = edit(document, curve, view, index)
            return document

        self._parts.change(f"{verb} {what}", changed)


def _smooth(document: Document, curve: int, view: CurveView, index: int) -> Document:
    before, after = _velocities(view, index)
    mean = ((before[0] + after[0]) / 2, (before[1] + after[1]) / 2)
    return edits.make_smooth(document, curve, index, mean)


def _corner(document: Document, curve: int, view: CurveView, index: int) -> Document:
    source = view.source
    if source.nodes[index].corner:
        return document
    if not source.is_closed and index in (0, len(source.nodes) - 1):
        raise EditError(f"Point {index} is an end of the curve; a corner needs curve on both sides.")
    return edits.make_corner(document, curve, index, *_velocities(view, index))


def _estimated(document: Document, curve: int, view: CurveView, index: int) -> Document:
    smooth = edits.make_smooth(document, curve, index, None)
    return edits.estimate_derivatives(smooth, curve, [index])


def _velocities(view: CurveView, index: int) -> tuple[Vector, Vector]:
    """Return the velocities that are shown before and after a node."""
    before, after = view.velocity_of(index, ahead=False), view.velocity_of(index, ahead=True)
    if before is None or after is None:
        raise EditError(f"There is no tangent at point {index} yet. {view.problem}")
    return before, after
