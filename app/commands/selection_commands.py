"""Move, scale and rotate the selected points or chosen curves; align and distribute points."""

from __future__ import annotations

from functools import partial

from app.commands.parts import Handlers, Parts
from app.document.transforms import Edge, align_nodes, distribute_nodes
from app.tools import words
from app.tools.transform import TransformKind
from app.view_model.curve_view import CurveView

_TRANSFORMS = {
    "moveSelection": TransformKind.MOVE,
    "scaleSelection": TransformKind.SCALE,
    "rotateSelection": TransformKind.ROTATE,
}
_ALIGNMENTS = {
    "alignLeft": Edge.LEFT,
    "alignCentre": Edge.CENTRE,
    "alignRight": Edge.RIGHT,
    "alignTop": Edge.TOP,
    "alignMiddle": Edge.MIDDLE,
    "alignBottom": Edge.BOTTOM,
}
_DISTRIBUTIONS = {"distributeHorizontally": 0, "distributeVertically": 1}
_AXIS_WORDS = ("horizontally", "vertically")


class SelectionCommands:
    """What is done to several points at once."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._session = parts.session
        self._actions = parts.actions
        shows_box = parts.preferences.transform_box
        self._actions["toggleTransformBox"].setChecked(shows_box)
        parts.canvas.set_box_visible(shows_box)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {
            **{name: partial(self._begin, kind) for name, kind in _TRANSFORMS.items()},
            **{name: partial(self._align, edge) for name, edge in _ALIGNMENTS.items()},
            **{name: partial(self._distribute, axis) for name, axis in _DISTRIBUTIONS.items()},
            "toggleTransformBox": self._toggle_box,
        }

    def render(self, view: CurveView) -> None:
        """Enable what there are enough points for."""
        count = len(self._session.selection)
        # The transforms act on all points where none is selected, and say so where there is none at all.
        for names, least in ((_ALIGNMENTS, 2), (_DISTRIBUTIONS, 3)):
            for name in names:
                self._actions[name].setEnabled(count >= least)

    def _begin(self, kind: TransformKind) -> None:
        if self._parts.canvas.is_moving_image:
            self._session.refuse("The image is being moved now; Escape goes back to the points.")
        else:
            self._parts.canvas.begin_transform(kind)

    def _align(self, edge: Edge) -> None:
        session, chosen = self._session, self._session.selection
        session.change(
            f"Align {words.points(chosen)} {edge.value}",
            lambda document: align_nodes(document, session.active_index, chosen, edge),
        )

    def _distribute(self, axis: int) -> None:
        session, chosen = self._session, self._session.selection
        session.change(
            f"Distribute {words.points(chosen)} {_AXIS_WORDS[axis]}",
            lambda document: distribute_nodes(document, session.active_index, chosen, axis),
        )

    def _toggle_box(self) -> None:
        shows_box = self._actions["toggleTransformBox"].isChecked()
        self._parts.preferences.transform_box = shows_box
        self._parts.canvas.set_box_visible(shows_box)
