"""The tools of one plot: which is in use, the gesture in flight, and the events that go to them."""

from __future__ import annotations

import math
from collections.abc import Callable

from msgspec.structs import replace

from ..document.limits import EditError
from ..document.model import Vector
from ..document.selection import SelectionState
from ..view_model.settings import SettingValues
from .background import Background
from .box import SelectionBox
from .editing_session import EditingSession
from .marks import Marks
from .pointer import ELSEWHERE, Hint, Part, Pointer
from .snapping import SnapTargets, with_snap
from .tool import (
    CANCELLED,
    THRESHOLD,
    CanvasQueries,
    Drag,
    Gesture,
    Tool,
    ToolEvent,
    ToolRecord,
)


class Toolbox:
    """Tools of one plot: a press asks the tool in use for a gesture; until that ends it gets all events.

    Attributes
    ----------
    record
        The tool that is chosen.
    canvas
        The plot: knows what lies under the pointer; its widget sets it.
    settings
        Values of the settings of all tools.
    snapping
        Whether and to what to snap; makes the snapper of a gesture.
    box
        The box around the selection, which transforms act on, and its pivot.
    background
        Does work that takes longer than a moment, whichever tool is in use by then.
    is_buttonless
        Whether the gesture in flight follows the pointer with no button down.
    """

    def __init__(self, session: EditingSession, record: ToolRecord) -> None:
        self.record = record
        self.canvas = CanvasQueries()
        self.settings = SettingValues()
        self.background = Background(lambda: not self.is_pressed)
        self._session = session
        self.snapping = SnapTargets(
            session,
            lambda: self.canvas.grid_spacing(),  # noqa: PLW0108 - it is set later
        )
        self.box = SelectionBox(session)
        self._tools = {record.name: record.make()}
        self._gesture: Gesture | None = None
        self.is_buttonless = False
        self._selection_before: SelectionState | None = None
        self._pointer = Pointer((0.0, 0.0), (0.0, 0.0))

    @property
    def tool(self) -> Tool:
        """The tool in use."""
        if self.record.name not in self._tools:
            self._tools[self.record.name] = self.record.make()
        return self._tools[self.record.name]

    @property
    def event(self) -> ToolEvent:
        """The event at the pointer, as things are now."""
        return ToolEvent(
            self._pointer,
            self._session,
            self.settings,
            self.snapping,
            self.box,
            self.background,
            self.canvas,
            self.tool,
        )

    def _at(self, pointer: Pointer) -> ToolEvent:
        self._pointer = pointer
        return self.event

    # The gesture in flight

    @property
    def is_pressed(self) -> bool:
        """Whether a gesture is in flight."""
        return self._gesture is not None

    @property
    def is_dragging(self) -> bool:
        """Whether the document is being dragged."""
        return isinstance(self._gesture, Drag)

    @property
    def scrolls_view(self) -> bool:
        """Whether a gesture is in flight that moves the view on at the edge."""
        return self._gesture is not None and self._gesture.scrolls_view

    def press(self, pointer: Pointer) -> None:
        """Begin the gesture of the tool in use, or end the one that follows the pointer without a button."""
        if self.is_buttonless:
            self.release(pointer)
        else:
            self.begin(lambda event: self.tool.press(event.with_hit()), pointer)

    def begin(
        self, make: Callable[[ToolEvent], Gesture | None], pointer: Pointer, *, buttonless: bool = False
    ) -> bool:
        """Begin the gesture that `make` returns; return whether there is one.

        `buttonless`: it follows the pointer with no button down until a click, Enter or Escape.
        """
        self._end()
        before = self._session.selected.state
        try:
            gesture = make(self._at(pointer))
        except EditError as reason:
            self._session.refuse(str(reason))
            return False
        if gesture is None:
            return False
        self._gesture, self.is_buttonless, self._selection_before = gesture, buttonless, before
        gesture.pressed_at = pointer.pixel
        if gesture.starts_at_press or buttonless:
            gesture.has_moved = True
            gesture.move(self.event)
        return True

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer; three pixels make a drag of a click."""
        gesture, event = self._gesture, self._at(pointer)
        if gesture is None:
            return
        if not gesture.has_moved:
            gesture.has_moved = math.dist(pointer.pixel, gesture.pressed_at) >= THRESHOLD
        if gesture.has_moved:
            gesture.move(event)

    def release(self, pointer: Pointer) -> None:
        """End the gesture: a drag where it has moved, else a click."""
        if pointer != self._pointer:
            self.move(pointer)
        if self._gesture is not None and self._gesture.follows_click and not self._gesture.has_moved:
            self.is_buttonless = self._gesture.has_moved = True
            return
        gesture = self._end()
        if gesture is not None and gesture.has_moved:
            gesture.release(self.event)
        elif gesture is not None:
            gesture.click(self.event)

    def cancel(self) -> bool:
        """Cancel the gesture in flight and the selection by its press; return whether there was one."""
        before, selected, gesture = self._selection_before, self._session.selected, self._end()
        if gesture is None:
            return False
        self._session.cancel()
        if before is not None and selected.state != before:
            selected.restore(before)
            self._session.say(CANCELLED)
        if gesture.has_moved:
            gesture.cancel(self.event)
        return True

    def abandon(self) -> None:
        """Forget the gesture in flight, without cancelling it: the session has dropped it."""
        self._end()

    def _end(self) -> Gesture | None:
        """Return the gesture that was in flight; from now on there is none."""
        gesture, self._gesture, self.is_buttonless = self._gesture, None, False
        self._selection_before = None
        self.snapping.reset()
        return gesture

    # No gesture in flight

    def choose(self, record: ToolRecord) -> None:
        """Use another tool from now on."""
        self.cancel()
        self.tool.deactivate(self.event)
        self.record = record
        self.tool.activate(self.event)
        if self.tool.edits_points and not self._session.selected.is_editing:
            # Whole curves are selected with the tool that selects alone; the others work on the active one.
            self._session.selected.edit_active()

    def hover(self, pointer: Pointer) -> Hint:
        """Return the hint: the effect of a press here."""
        event = self._at(pointer).with_hit()
        self.snapping.reset()
        hint, highlighted = self.tool.hover(event), -1
        if hint.highlighted is not None:
            highlighted = hint.highlighted
        elif event.hit is not None and event.hit.part is Part.POINT:
            highlighted = event.hit.index
        self._session.selected.set_hovered(highlighted)
        return hint

    def leave(self) -> None:
        """Remove the preview of a press: the pointer has left."""
        self._session.selected.set_hovered(-1)
        self.snapping.reset()
        self.tool.hover(self._at(ELSEWHERE))

    def dismiss(self) -> bool:
        """Cancel background work, or remove marks that the tool has left; return whether there were any."""
        if self.background.cancel():
            self._session.say(CANCELLED)
            return True
        return self.tool.dismiss(self.event)

    def reset(self) -> None:
        """Forget the state that belongs to the document: another one is open."""
        self.background.cancel()
        self._tools = {}

    # Keys

    def wants_key(self, key: str) -> bool:
        """Return whether a key is for the gesture or the tool that would be a shortcut otherwise."""
        if self._gesture is not None:
            return self._gesture.wants_key(key)
        return self.tool.wants_key(self.event, key)

    def key(self, key: str, pointer: Pointer | None = None) -> bool:
        """Give the gesture, or the tool, a key; return whether it had an effect, and was not refused."""
        gesture, event = self._gesture, self.event
        try:
            if gesture is None:
                return self.tool.key(event if pointer is None else event.at(pointer), key)
            had_effect = gesture.key(event, key)
        except EditError as reason:
            self._session.refuse(str(reason))
            return False
        if key == "enter" and gesture.wants_key(key):
            self.release(self._pointer)
            return True
        if had_effect:
            gesture.has_moved = True
            gesture.move(event)
        return had_effect

    # What is drawn and said

    def marks(self) -> Marks:
        """Return the marks over the plot."""
        event, gesture = self.event, self._gesture
        marks = self.tool.marks(event) if gesture is None else gesture.marks(event)
        if self.is_buttonless:
            # What a tool has left on the plot stays there meanwhile.
            marks = replace(marks, ruler=self.tool.marks(event).ruler)
        if self.background.lines:
            marks = replace(marks, waiting=self.background.lines)
        if marks.pivot is None and (pivot := self.box.pivot) is not None:
            # A pivot that was set is drawn whatever tool is in use.
            marks = replace(marks, pivot=pivot)
        return marks

    def status(self) -> str:
        """Return the sentence about the gesture in flight, with its snap."""
        if self._gesture is None or not self._gesture.has_moved:
            return ""
        return with_snap(self._gesture.status(self.event), self.snapping.caught)

    def dragged_position(self) -> Vector | None:
        """Return the position of the point that is dragged, None while none is."""
        is_moving = self._gesture is not None and self._gesture.has_moved
        return self._gesture.position_at(self._pointer) if self._gesture is not None and is_moving else None
