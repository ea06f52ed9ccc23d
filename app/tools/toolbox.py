"""The tools of one plot: which is in use, and the events that go to it."""

from __future__ import annotations

import math
from collections.abc import Callable

from msgspec.structs import replace

from ..document.limits import EditError
from ..document.model import Vector
from .background import Background
from .drag_machine import DragMachine
from .editing_session import EditingSession
from .gesture import CANCELLED, THRESHOLD, Drag, Gesture
from .marks import Marks
from .pointer import ELSEWHERE, Hint, Pointer, Stride
from .snappers import SnapTargets
from .snapping import with_snap
from .target import SelectionBox
from .tool import CanvasQueries, Tool, ToolEvent, ToolRecord, ToolSettings
from .transform import TransformKind
from .transform_drags import TransformTool


class Toolbox:
    """Tools of one plot: events go to the one in use, each with its event.

    A tool may lie above the one that is chosen, for a while: the transform that a key has begun, or the one
    that moves the picture. Then the events are its own.

    Attributes
    ----------
    record
        The tool that is chosen.
    surface
        The plot: tells what lies under the pointer, for one; whoever shows it sets it.
    settings
        What the person has chosen.
    target
        Subject of the transforms, and their pivot.
    background
        Does what takes longer than a moment, whichever tool is in use by then.
    """

    def __init__(self, session: EditingSession, record: ToolRecord) -> None:
        self.record = record
        self.canvas = CanvasQueries()
        self.settings = ToolSettings()
        self.background = Background(lambda: not self.is_pressed and not self.is_transforming)
        self._session = session
        self._drags = DragMachine(session)
        self._snapping = SnapTargets(
            session,
            lambda: self.settings.snapping,
            lambda: self.grid(),  # noqa: PLW0108 - it is set later
        )
        self.box = SelectionBox(session)
        self._made = {record.name: record.make()}
        self._chosen = self._made[record.name]
        self._above: Tool | None = None
        self._gesture: Gesture | None = None
        # Whether the gesture follows the pointer with no button down.
        self._is_buttonless = False
        self._pointer = Pointer((0.0, 0.0), (0.0, 0.0))

    @property
    def tool(self) -> Tool:
        """The tool in use."""
        return self._above or self._chosen

    @property
    def event(self) -> ToolEvent:
        """The event of the last event, as things are now."""
        return ToolEvent(
            self._pointer,
            self._session,
            self.settings,
            self._drags,
            self._snapping,
            self.box,
            self.background,
            self.canvas,
            self.tool,
        )

    def grid(self) -> float:
        """Return the spacing of the grid at the present zoom."""
        return self.canvas.grid_spacing()

    @property
    def is_pressed(self) -> bool:
        """Whether a gesture is in flight."""
        return self._gesture is not None or self._drags.is_pressed or self.tool.gesture is not None

    @property
    def scrolls(self) -> bool:
        """Whether a gesture is in flight that moves the view on at the edge."""
        if self._gesture is not None:
            return self._gesture.scrolls_view
        return self.tool.gesture is not None or self._drags.scrolls

    @property
    def is_dragging(self) -> bool:
        """Whether the document is being dragged."""
        return self._drags.is_pressed or isinstance(self._gesture, Drag)

    @property
    def is_transforming(self) -> bool:
        """Whether a transform follows the pointer with no button down."""
        return self._is_buttonless or (self._above is not None and self._above.lasts_one_gesture)

    # Which tool

    def choose(self, record: ToolRecord) -> None:
        """Use another tool from now on."""
        self.cancel()
        self._chosen.dismiss(self.event)
        self.record = record
        self._chosen = self._of(record)
        self._chosen.pick_up()
        if self._chosen.takes_up(self.event) and not self._session.selected.is_editing:
            # Whole curves are chosen with the tool that selects alone; the others work on the active one.
            self._session.selected.take_up()
            self._chosen.take_over(self.event)

    def lay_above(self, record: ToolRecord | None) -> None:
        """Use a tool in place of the one that is chosen, until None gives way to that again."""
        self.cancel()
        self._above = self._of(record) if record is not None else None

    def _of(self, record: ToolRecord) -> Tool:
        if record.name not in self._made:
            self._made[record.name] = record.make()
        return self._made[record.name]

    def begin_transform(self, kind: TransformKind, pointer: Pointer) -> bool:
        """Let the selected points or curves follow the pointer; return whether they do."""
        if self.is_transforming:
            return self.key(kind.key)
        if self.is_pressed:
            return False
        event = self._at(pointer)
        if refusal := event.box.refusal_of_keys:
            self._session.refuse(refusal)
            return False
        self._above = TransformTool(kind, event)
        return True

    def begin_with(self, make: Callable[[ToolEvent], Tool], pointer: Pointer) -> None:
        """Begin a gesture of a tool that lies above the one that is chosen until the gesture has ended."""
        self.cancel()
        self._above = make(self._at(pointer))

    def begin(
        self, make: Callable[[ToolEvent], Gesture], pointer: Pointer, *, buttonless: bool = False
    ) -> bool:
        """Begin a gesture that is not a press of the tool in use; return whether it has begun.

        `buttonless`: it follows the pointer with no button down until a click, Enter or Escape.
        """
        self.cancel()
        event = self._at(pointer)
        try:
            gesture = make(event)
        except EditError as reason:
            self._session.refuse(str(reason))
            return False
        self._is_buttonless = buttonless
        self._start(gesture)
        return True

    def _start(self, gesture: Gesture) -> None:
        self._gesture, gesture.pressed_at = gesture, self._pointer.pixel
        if gesture.starts_at_press or self._is_buttonless:
            gesture.has_moved = True
            gesture.move(self.event)

    # Events

    def press(self, pointer: Pointer) -> None:
        """Begin a gesture, or end the one that keys began."""
        if self._is_buttonless:
            self.release(pointer)
            return
        if not self.is_transforming:
            self._end()
        gesture = None
        try:
            gesture = self.tool.press(self._at(pointer).with_hit())
        except EditError as reason:
            self._session.refuse(str(reason))
        if gesture is not None:
            self._start(gesture)
        self._give_way()

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        gesture, event = self._gesture, self._at(pointer)
        if gesture is None:
            self.tool.move(event)
            return
        if not gesture.has_moved:
            gesture.has_moved = math.dist(pointer.pixel, gesture.pressed_at) >= THRESHOLD
        if gesture.has_moved:
            gesture.move(event)

    def release(self, pointer: Pointer) -> None:
        """End the gesture."""
        if self._gesture is not None:
            if pointer != self._pointer:
                self.move(pointer)
            gesture = self._take_gesture()
            event = self._at(pointer)
            if gesture is not None and gesture.has_moved:
                gesture.release(event)
            elif gesture is not None:
                gesture.click(event)
            self._snapping.reset()
            return
        self.tool.release(self._at(pointer))
        self._give_way()
        self._end()

    def hover(self, pointer: Pointer) -> Hint:
        """Return what a press here would do."""
        tool, event = self.tool, self._at(pointer)
        if self.is_transforming:
            return tool.hover(event)
        event = event.with_hit()
        self._session.selected.set_hovered(tool.lit(event.hit))
        self._snapping.reset()
        return tool.hover(event)

    def leave(self) -> None:
        """Show nothing of what a press would do: the pointer has left."""
        self._session.selected.set_hovered(-1)
        self._snapping.reset()
        self.tool.hover(self._at(ELSEWHERE))

    def claims(self, key: str) -> bool:
        """Whether a key is for the tool that would be a shortcut otherwise."""
        if self._gesture is not None:
            return self._gesture.wants_key(key)
        return self.tool.claims(self.event, key)

    def key(self, key: str) -> bool:
        """Give the tool a key; return whether it meant something, and was not refused."""
        try:
            if self._gesture is not None:
                return self._key_of_gesture(self._gesture, key)
            taken = self.tool.key(self.event, key)
        except EditError as reason:
            self._session.refuse(str(reason))
            taken = False
        self._give_way()
        return taken

    def _key_of_gesture(self, gesture: Gesture, key: str) -> bool:
        if key == "enter" and gesture.wants_key(key):
            gesture.has_moved = True
            self.release(self._pointer)
            return True
        if not gesture.key(self.event, key):
            return False
        gesture.has_moved = True
        gesture.move(self.event)
        return True

    def nudge(self, direction: Vector, stride: Stride) -> bool:
        """Move what the tool moves by an arrow key; return whether the key meant something."""
        return not self.is_pressed and self.tool.nudge(self.event, direction, stride)

    def walk(self, step: int) -> bool:
        """Go to the next thing (1) or the one before (−1); return whether there is one."""
        return self.tool.walk(self.event, step)

    def cancel(self) -> bool:
        """Take the gesture in flight back; return whether there was one."""
        was_pressed, gesture = self.is_pressed, self._take_gesture()
        if gesture is not None and gesture.has_moved:
            gesture.cancel(self.event)
        self.tool.cancel(self.event)
        self._give_way()
        self._end()
        return was_pressed

    def abandon(self) -> None:
        """Drop the gesture in flight; the document is somebody else's now."""
        self._take_gesture()
        self._drags.reset()
        self._give_way()
        self._end()

    def _take_gesture(self) -> Gesture | None:
        """Return the gesture in flight; from now on there is none."""
        gesture, self._gesture, self._is_buttonless = self._gesture, None, False
        return gesture

    def dismiss(self) -> bool:
        """Drop what is being done, or remove what the tool has left on the plot; return whether there was."""
        if self.background.cancel():
            self._session.say(CANCELLED)
            return True
        return self._chosen.dismiss(self.event)

    def reset(self) -> None:
        """Forget what concerns the document; another one is open."""
        self.background.cancel()
        for tool in self._made.values():
            tool.reset()

    def _at(self, pointer: Pointer) -> ToolEvent:
        self._pointer = pointer
        return self.event

    def _end(self) -> None:
        self.tool.end()
        self._snapping.reset()

    def _give_way(self) -> None:
        """Go back to the tool that is chosen when the one above it has done what it was there for."""
        if self.is_transforming and not self._drags.is_pressed:
            self._above = None
            self._end()

    # What is shown

    def marks(self) -> Marks:
        """Return what is drawn over the plot."""
        event, gesture = self.event, self._gesture
        marks = gesture.marks(event) if gesture is not None else self._chosen.marks(event)
        if self.background.lines:
            marks = replace(marks, waiting=self.background.lines)
        if marks.pivot is None and (pivot := self.box.pivot) is not None:
            # One that was chosen is there whatever tool is in use.
            marks = replace(marks, pivot=pivot)
        return self._above.marks(self.event).above(marks) if self._above is not None else marks

    def progress(self) -> str:
        """Return how far the gesture in flight has come, as a sentence for the status line."""
        if self._gesture is not None:
            text = self._gesture.status(self._pointer) if self._gesture.has_moved else ""
            return with_snap(text, self._snapping.caught)
        return self.tool.progress(self.event)

    def place(self) -> Vector | None:
        """Return where the point is that is dragged, None while none is."""
        if self._gesture is not None:
            return self._gesture.position_at(self._pointer) if self._gesture.has_moved else None
        return self._drags.place_at(self._pointer)
