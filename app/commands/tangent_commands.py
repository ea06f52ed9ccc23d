"""The tangents at the selected points: smooth, corner, left to the rules, or pulled out."""

from __future__ import annotations

from collections.abc import Callable, Collection

from app.commands.parts import Handlers, Parts
from app.document import edits
from app.document.curve_edits import replace_curve
from app.document.edits import EditError
from app.document.model import Curve, Document, Node
from app.panels.words import count_of
from app.view_model.curve_view import CurveView
from app.view_model.handles import with_velocities_pulled
from app.view_model.smoothness import made_smooth, with_corners

_KINDS = ("tangentSmooth", "tangentCorner", "tangentEstimated")

_VISIBLE = 16.0
"""Pixels from a point at which a handle is clear of the point's disc."""


class TangentCommands:
    """The menu Curve › Tangents."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._session = parts.session

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {
            "tangentSmooth": lambda: self._reshape("Smooth", made_smooth),
            "tangentCorner": lambda: self._reshape("Corner at", with_corners),
            "tangentEstimated": lambda: self._apply("Estimate", self._estimate),
            "pullVelocity": lambda: self._reshape("Pull out velocity of", self._pulled),
        }

    def render(self, view: CurveView) -> None:
        """Enable the actions where there are points with tangents, and mark what all of them are."""
        chosen = self._session.selection
        usable = bool(chosen) and view.source.family.derivatives > 0 and view.is_current
        kinds = {_tangent_at(view.source.nodes[index]) for index in chosen} if usable else set()
        for name in _KINDS:
            self._parts.actions[name].setEnabled(usable)
            self._parts.actions[name].setChecked(kinds == {name})
        self._parts.actions["pullVelocity"].setEnabled(usable)

    def _pulled(self, view: CurveView, chosen: Collection[int]) -> Curve:
        pulled = with_velocities_pulled(view, chosen, _VISIBLE * self._parts.canvas.pixel_size)
        if pulled == view.source:
            what = "velocity stands" if len(chosen) == 1 else "velocities stand"
            raise EditError(f"The {what} out already; drag the square handle.")
        return pulled

    def _reshape(self, verb: str, made: Callable[[CurveView, Collection[int]], Curve]) -> None:
        """Put the curve that `made` returns for the selected points in the place of the active one."""
        session, view = self._session, self._session.active_view
        self._apply(
            verb,
            lambda chosen: replace_curve(session.document, session.active_index, made(view, chosen)),
        )

    def _estimate(self, chosen: Collection[int]) -> Document:
        document, curve = self._session.document, self._session.active_index
        for index in chosen:
            document = edits.make_smooth(document, curve, index, None)
        return edits.estimate_derivatives(document, curve, chosen)

    def _apply(self, verb: str, edit: Callable[[Collection[int]], Document]) -> None:
        chosen = sorted(self._session.selection)
        if not chosen:
            return
        what = f"point {chosen[0]}" if len(chosen) == 1 else count_of(len(chosen), "point")
        self._parts.change(f"{verb} {what}", lambda: edit(chosen))
        # A mark that was clicked off shows what is, also where nothing changed.
        self.render(self._session.active_view)


def _tangent_at(node: Node) -> str:
    """Return the name of the action that makes a node what it is."""
    if node.corner:
        return "tangentCorner"
    set_by_hand = node.velocity is not None or node.acceleration is not None
    return "tangentSmooth" if set_by_hand else "tangentEstimated"
