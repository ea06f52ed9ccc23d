"""Transform panel in the window: its values and its changes of the document."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from ...actions.declaration import action
from ...actions.menus import ALIGN_BUTTONS, ARRANGE_PANEL, TRANSFORM_BUTTONS
from ...document.model import Document, Vector
from ...document.several_curves import move_group, transform_group
from ...document.transforms import rotation, skew
from ...document.words import number
from ...state.window_state import WindowState
from ...view_model.boxes import NINE
from ...view_model.curve.curve_view import CurveView
from ...view_model.pivot import Turning
from ...view_model.resize import SIDES, resized
from ...workbench.context import WindowContext
from ...workbench.docks import Panel, make_room
from .. import transform

if TYPE_CHECKING:
    from .panel import TransformPanel, TransformValues

_HEIGHT = 360


class TransformPanelCommands(QObject):
    """Keeps the panel in step with the selection, as long as its dock is in sight."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context, self._session, self._store = context, context.session, context.store
        self._target = context.central.canvas.tools.box
        self._panel: TransformPanel | None = None
        self._turning: Turning | None = None
        self._dock = context.docks["transformDock"]
        self._is_visible = False
        self._dock.visibilityChanged.connect(self._follow_visibility)
        self._session.pivot_changed.connect(self._render)
        self._store.changed.connect(self._show_state)

    @Panel("transformDock", "Transform", on_demand=True, is_steady=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the content of the dock; called when it is first looked at."""
        actions = self._context.actions
        self._panel = panel = transform.panel.TransformPanel(
            transform.panel.PanelActions(
                actions.in_bar(TRANSFORM_BUTTONS)[1],
                list(actions.in_bar(ALIGN_BUTTONS).values()),
                actions["keepProportions"],
            ),
            parent,
        )
        panel.moved.connect(self._move)
        panel.sized.connect(self._size)
        panel.turned_to.connect(self._turn_to)
        panel.turned_by.connect(self._turn_by)
        panel.skewed.connect(self._skew)
        panel.pivot_picked.connect(self._choose_pivot)
        panel.reference_picked.connect(lambda reference: self._store.change(align_to=reference))
        panel.refused.connect(self._session.refuse)
        panel.render_reference(self._store.state.align_to)
        return panel

    @action(
        "openTransform",
        "Transform Panel…",
        ARRANGE_PANEL,
        "Ctrl+Shift+M",
        icon="transform-box",
        keywords="exact width height position angle size pivot align",
    )
    def _open(self) -> None:
        """Set position, size and angle by numbers with units; align and distribute."""
        self._dock.bring_up()
        make_room(self._context.window, self._dock, _HEIGHT)
        if self._panel is not None:
            self._is_visible = True
            self._render()
            width = self._panel.width_edit
            width.setFocus()
            # Selected backwards, so that the first digits are visible.
            width.setSelection(len(width.text()), -len(width.text()))

    # What is shown

    def _follow_visibility(self, visible: bool) -> None:
        self._is_visible = visible
        self._render()

    def _show_state(self, _before: WindowState, state: WindowState) -> None:
        if self._panel is not None:
            self._panel.render_reference(state.align_to)
            self._render()

    def render_panel(self, _view: CurveView) -> None:
        """Show the selection as it is now."""
        self._render()

    def _render(self) -> None:
        if self._panel is not None and self._is_visible:
            self._panel.render_values(self._values())

    def _values(self) -> TransformValues:
        target, session = self._target, self._session
        if target.is_nothing:
            return transform.panel.TransformValues("Nothing selected", None, (0.0, 0.0), None, 0.0, "", "")
        bounds = target.bounds
        words, group = target.words, target.for_keys
        # Names are unchanged; other labels begin with a capital letter.
        what = words if group.name else f"{words[0].upper()}{words[1:]}"
        return transform.panel.TransformValues(
            what, bounds, self._target.centre,
            self._pivot_position, self._angle(),
            session.document.unit, target.refusal_of_keys
        )  # fmt: skip

    @property
    def _pivot_position(self) -> tuple[int, int] | None:
        """The one of nine positions in the box that is the pivot; None for another pivot."""
        bounds, pivot = self._target.bounds, self._target.pivot
        if pivot is None:
            return (0, 0)
        matches = [at for at in NINE if bounds.position(*at) == pivot]
        return matches[len(matches) // 2] if matches else None

    def _angle(self) -> float:
        now = self._target.anchored()
        angle = self._turning.at(now) if self._turning is not None else None
        if angle is None:
            angle, self._turning = 0.0, Turning(now)
        return angle

    # Input of the user

    def _change(self, text: str, edit: Callable[[Document], Document]) -> None:
        stays = self._target.for_keys.remark
        if refusal := (change := self._session.change(text, edit)).refusal:
            self._refuse(refusal)
        elif change and stays:
            self._session.say(f"{stays}.")
        self._render()

    def _refuse(self, reason: str) -> None:
        if self._panel is not None:
            self._panel.refuse(reason)

    def _length(self, value: float) -> str:
        return f"{number(value, 6, step=0.001)} {self._session.document.unit}".rstrip()

    def _choose_pivot(self, across: int, up: int) -> None:
        forgets = (across, up) == (0, 0)
        self._target.pivot = None if forgets else self._target.bounds.position(across, up)
        self._render()

    def _move(self, axis: int, value: float) -> None:
        group = self._target.for_keys
        distance = value - self._target.centre[axis]
        by = (distance, 0.0) if axis == 0 else (0.0, distance)
        text = f"Move {self._target.words} to {'xy'[axis]} {self._length(value)}"
        self._change(text, lambda document: move_group(document, group, by))

    def _size(self, axis: int, value: float) -> None:
        session, group, about = self._session, self._target.for_keys, self._target.centre
        is_even = self._store.state.keep_proportions

        def sized(document: Document) -> Document:
            return resized(document, session.views, group, axis, value, about, keeps_proportions=is_even)

        self._change(f"Set {SIDES[axis]} of {self._target.words} to {self._length(value)}", sized)

    def _turn_to(self, degrees: float) -> None:
        centre = self._target.pivot or self._first_middle()
        self._turn(degrees - self._angle(), centre, f"to {number(degrees, 6)}°")

    def _first_middle(self) -> Vector:
        """Return the current position of the centre at angle 0, so that rotating back to 0 moves nothing."""
        before = self._turning.anchor if self._turning is not None else None
        now = self._target.anchored()
        by = before.since(now) if before is not None else None
        if before is None or before.bounds is None or by is None:
            return self._target.centre
        return by.point(before.bounds.centre)

    def _turn_by(self, degrees: float) -> None:
        self._turn(degrees, self._target.centre, f"by {number(degrees, 6)}°")

    def _skew(self, axis: int, degrees: float) -> None:
        group, about, by = self._target.for_keys, self._target.centre, degrees
        self._change(
            f"Skew {self._target.words} by {number(degrees, 6)}° along {'xy'[axis]}",
            lambda document: transform_group(document, group, skew(axis, by, about)),
        )

    def _turn(self, degrees: float, about: Vector, how: str) -> None:
        group, by = self._target.for_keys, rotation(degrees, about)
        self._change(
            f"Rotate {self._target.words} {how}", lambda document: transform_group(document, group, by)
        )
