"""Move, scale and rotate the selected points or selected curves; align and distribute points."""

from __future__ import annotations

from typing import NamedTuple

from ...actions.declaration import Action, action, action_for_each, also_for_each
from ...actions.needs import THREE_SELECTED, TWO_SELECTED
from ...actions.sections import (
    EDIT_ALIGN_ACROSS,
    EDIT_ALIGN_UP,
    EDIT_DISTRIBUTE,
    EDIT_TRANSFORM,
    EDIT_TRANSFORM_BOX,
    Section,
)
from ...actions.strips import CURVE_MENU
from ...document import words
from ...document.several_curves import mapped
from ...document.transforms import Edge, align_points, distribute_points, flipping
from ...state.window_state import WindowState
from ...tools.transform import TransformKind
from ...workbench.context import WindowContext


class _Transform(NamedTuple):
    """A transform by the pointer, and the words of its action."""

    kind: TransformKind
    text: str
    key: str
    tip: str


class _Flip(NamedTuple):
    """Mirror image, and the words of its action."""

    way: str
    axis: int
    key: str
    tip: str


class _Alignment(NamedTuple):
    """Alignment of points, and the words of its action."""

    edge: Edge
    section: Section
    tip: str


_TRANSFORMS = (
    _Transform(
        TransformKind.MOVE, "Move", "G",
        "Move what is selected or chosen, or else all points, with the pointer; type x, Tab, y",
    ),
    _Transform(
        TransformKind.SCALE, "Scale", "S",
        "Scale what is selected or chosen, or else all points, with the pointer; type a factor, or x, Tab, y",
    ),
    _Transform(
        TransformKind.ROTATE, "Rotate", "R",
        "Rotate what is selected or chosen, or else all points, with the pointer; type the angle",
    ),
)  # fmt: skip

_FLIPS = (
    _Flip("horizontally", 0, "H", "Mirror what is selected or chosen, or else all points: left is right"),
    _Flip("vertically", 1, "Shift+V", "Mirror what is selected or chosen, or else all points: top is bottom"),
)

_ALIGNMENTS = (
    _Alignment(Edge.LEFT, EDIT_ALIGN_ACROSS, "Put the selected points below the leftmost one"),
    _Alignment(Edge.CENTRE, EDIT_ALIGN_ACROSS, "Put the selected points on one vertical, halfway"),
    _Alignment(Edge.RIGHT, EDIT_ALIGN_ACROSS, "Put the selected points below the rightmost one"),
    _Alignment(Edge.TOP, EDIT_ALIGN_UP, "Put the selected points level with the highest one"),
    _Alignment(Edge.MIDDLE, EDIT_ALIGN_UP, "Put the selected points on one horizontal, halfway"),
    _Alignment(Edge.BOTTOM, EDIT_ALIGN_UP, "Put the selected points level with the lowest one"),
)


class SelectionCommands:
    """Actions on several points at once."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._session = context.session
        context.central.canvas.change_tool_settings(shows_box=context.store.state.transform_box)
        context.store.changed.connect(self._show_state)
        self._target = context.central.canvas.tools.target
        self._session.history_changed.connect(self._target.keep_pivot)
        self._session.pivot_changed.connect(context.central.canvas.show_marks)

    def _show_state(self, before: WindowState, after: WindowState) -> None:
        if after.transform_box != before.transform_box:
            self._context.central.canvas.change_tool_settings(shows_box=after.transform_box)

    @action_for_each(
        _TRANSFORMS,
        lambda each: Action(
            f"{each.kind.name.lower()}Selection",
            each.text,
            EDIT_TRANSFORM,
            each.key,
            each.text.lower(),
            each.tip,
            f"{each.text} Points",
            during_gesture=True,
        ),
    )
    def _begin(self, each: _Transform) -> None:
        if self._context.store.state.moves_image:
            self._session.refuse("The image is being moved now; Escape goes back to the points.")
        else:
            self._context.central.canvas.begin_transform(each.kind)

    @action_for_each(
        _FLIPS,
        lambda each: Action(
            f"flip{each.way.capitalize()}",
            f"Flip {each.way.capitalize()}",
            EDIT_TRANSFORM,
            each.key,
            f"flip-{each.way}",
            each.tip,
            keywords="mirror reflect",
        ),
    )
    @also_for_each(lambda each: (CURVE_MENU(16 + each.axis),))
    def _flip(self, each: _Flip) -> None:
        target, session = self._target, self._session
        self._context.cancel_gesture()
        if refusal := target.refusal_of_keys:
            session.refuse(refusal)
            return
        group, by = target.for_keys, flipping(each.axis, target.centre)
        session.change(f"Flip {target.words} {each.way}", lambda document: mapped(document, group, by))

    @action_for_each(
        _ALIGNMENTS,
        lambda each: Action(
            f"align{each.edge.name.capitalize()}",
            each.edge.name.capitalize(),
            each.section,
            "",
            f"align-{each.edge.name.lower()}",
            each.tip,
            f"Align {each.edge.name.capitalize()}",
            needs=TWO_SELECTED,
        ),
    )
    def _align(self, each: _Alignment) -> None:
        session, selected = self._session, self._session.selection
        session.change(
            f"Align {words.points(selected)} {each.edge.value}",
            lambda document: align_points(document, session.active_index, selected, each.edge),
        )

    @action(
        "distributeHorizontally",
        "Distribute Horizontally",
        EDIT_DISTRIBUTE,
        icon="distribute-horizontally",
        needs=THREE_SELECTED,
    )
    def _distribute_horizontally(self) -> None:
        """Space the selected points evenly from left to right."""
        self._distribute(0, "horizontally")

    @action(
        "distributeVertically",
        "Distribute Vertically",
        EDIT_DISTRIBUTE,
        icon="distribute-vertically",
        needs=THREE_SELECTED,
    )
    def _distribute_vertically(self) -> None:
        """Space the selected points evenly from bottom to top."""
        self._distribute(1, "vertically")

    def _distribute(self, axis: int, way: str) -> None:
        session, selected = self._session, self._session.selection
        session.change(
            f"Distribute {words.points(selected)} {way}",
            lambda document: distribute_points(document, session.active_index, selected, axis),
        )

    @action(
        "toggleTransformBox",
        "Box with Grips",
        EDIT_TRANSFORM_BOX,
        icon="transform-box",
        full_name="Transform Box with Grips",
        checked=lambda now: now.state.transform_box,
        during_gesture=True,
    )
    def _toggle_box(self) -> None:
        """Show a box with grips around two or more selected points, or around selected curves."""
        store = self._context.store
        store.change(transform_box=not store.state.transform_box)


COMMAND_SETS = (SelectionCommands,)
