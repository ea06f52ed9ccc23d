"""The tools of one plot: which is in use, and the events that go to it."""

from __future__ import annotations

from collections.abc import Callable

from msgspec.structs import replace

from ..document.edits import EditError
from ..document.model import Vector
from .background import Background
from .drag_machine import CANCELLED, DragMachine, EditingHost
from .marks import GestureMarks
from .pointer import ELSEWHERE, Hint, Pointer, Stride
from .snappers import Snappers
from .target import TransformTarget
from .tool import Surface, Tool, ToolContext, ToolRecord, ToolSettings
from .transform import TransformKind
from .transform_drags import TransformTool


class Toolbox:
    """Tools of one plot: events go to the one in use, each with its context.

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

    def __init__(self, host: EditingHost, record: ToolRecord) -> None:
        self.record = record
        self.surface = Surface()
        self.settings = ToolSettings()
        self.background = Background(lambda: not self.is_pressed and not self.is_transforming)
        self._host = host
        self._drags = DragMachine(host)
        self._snappers = Snappers(
            host,
            lambda: self.settings.snapping,
            lambda: self.grid(),  # noqa: PLW0108 - it is set later
        )
        self.target = TransformTarget(host)
        self._made = {record.name: record.make()}
        self._chosen = self._made[record.name]
        self._above: Tool | None = None
        self._pointer = Pointer((0.0, 0.0), (0.0, 0.0))

    @property
    def tool(self) -> Tool:
        """The tool in use."""
        return self._above or self._chosen

    @property
    def context(self) -> ToolContext:
        """The context of the last event, as things are now."""
        return ToolContext(
            self._pointer,
            self._host,
            self.settings,
            self._drags,
            self._snappers,
            self.target,
            self.background,
            self.surface,
            self.tool,
        )

    def grid(self) -> float:
        """Return the spacing of the grid at the present zoom."""
        return self.surface.grid_spacing()

    @property
    def is_pressed(self) -> bool:
        """Whether a gesture is in flight."""
        return self._drags.is_pressed or self.tool.gesture is not None

    @property
    def scrolls(self) -> bool:
        """Whether a gesture is in flight that moves the view on at the edge."""
        return self.tool.gesture is not None or self._drags.scrolls

    @property
    def is_dragging(self) -> bool:
        """Whether the document is being dragged."""
        return self._drags.is_pressed

    @property
    def is_transforming(self) -> bool:
        """Whether a transform follows the pointer with no button down."""
        return self._above is not None and self._above.lasts_one_gesture

    # Which tool

    def choose(self, record: ToolRecord) -> None:
        """Use another tool from now on."""
        self.cancel()
        self._chosen.dismiss(self.context)
        self.record = record
        self._chosen = self._of(record)
        self._chosen.pick_up()
        if self._chosen.takes_up(self.context) and not self._host.selected.is_editing:
            # Whole curves are chosen with the tool that selects alone; the others work on the active one.
            self._host.selected.take_up()
            self._chosen.take_over(self.context)

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
        context = self._at(pointer)
        if refusal := context.target.refusal_of_keys:
            self._host.refuse(refusal)
            return False
        self._above = TransformTool(kind, context)
        return True

    def begin_with(self, make: Callable[[ToolContext], Tool], pointer: Pointer) -> None:
        """Begin a gesture of a tool that lies above the one that is chosen until the gesture has ended."""
        self.cancel()
        self._above = make(self._at(pointer))

    # Events

    def press(self, pointer: Pointer) -> None:
        """Begin a gesture, or end the one that keys began."""
        if not self.is_transforming:
            self._end()
        try:
            self.tool.press(self._at(pointer).with_hit())
        except EditError as reason:
            self._host.refuse(str(reason))
        self._give_way()

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        self.tool.move(self._at(pointer))

    def release(self, pointer: Pointer) -> None:
        """End the gesture."""
        self.tool.release(self._at(pointer))
        self._give_way()
        self._end()

    def hover(self, pointer: Pointer) -> Hint:
        """Return what a press here would do."""
        tool, context = self.tool, self._at(pointer)
        if self.is_transforming:
            return tool.hover(context)
        context = context.with_hit()
        self._host.selected.set_hovered(tool.lit(context.hit))
        self._snappers.reset()
        return tool.hover(context)

    def leave(self) -> None:
        """Show nothing of what a press would do: the pointer has left."""
        self._host.selected.set_hovered(-1)
        self._snappers.reset()
        self.tool.hover(self._at(ELSEWHERE))

    def claims(self, key: str) -> bool:
        """Whether a key is for the tool that would be a shortcut otherwise."""
        return self.tool.claims(self.context, key)

    def key(self, key: str) -> bool:
        """Give the tool a key; return whether it meant something, and was not refused."""
        try:
            taken = self.tool.key(self.context, key)
        except EditError as reason:
            self._host.refuse(str(reason))
            taken = False
        self._give_way()
        return taken

    def nudge(self, direction: Vector, stride: Stride) -> bool:
        """Move what the tool moves by an arrow key; return whether the key meant something."""
        return not self.is_pressed and self.tool.nudge(self.context, direction, stride)

    def walk(self, step: int) -> bool:
        """Go to the next thing (1) or the one before (−1); return whether there is one."""
        return self.tool.walk(self.context, step)

    def cancel(self) -> bool:
        """Take the gesture in flight back; return whether there was one."""
        was_pressed = self.is_pressed
        self.tool.cancel(self.context)
        self._give_way()
        self._end()
        return was_pressed

    def abandon(self) -> None:
        """Drop the gesture in flight; the document is somebody else's now."""
        self._drags.reset()
        self._give_way()
        self._end()

    def dismiss(self) -> bool:
        """Drop what is being done, or remove what the tool has left on the plot; return whether there was."""
        if self.background.cancel():
            self._host.say(CANCELLED)
            return True
        return self._chosen.dismiss(self.context)

    def reset(self) -> None:
        """Forget what concerns the document; another one is open."""
        self.background.cancel()
        for tool in self._made.values():
            tool.reset()

    def _at(self, pointer: Pointer) -> ToolContext:
        self._pointer = pointer
        return self.context

    def _end(self) -> None:
        self.tool.end()
        self._snappers.reset()

    def _give_way(self) -> None:
        """Go back to the tool that is chosen when the one above it has done what it was there for."""
        if self.is_transforming and not self._drags.is_pressed:
            self._above = None
            self._end()

    # What is shown

    def marks(self) -> GestureMarks:
        """Return what is drawn over the plot."""
        marks = self._chosen.marks(self.context)
        if self.background.lines:
            marks = replace(marks, waiting=self.background.lines)
        if marks.pivot is None and (pivot := self.target.pivot) is not None:
            # One that was chosen is there whatever tool is in use.
            marks = replace(marks, pivot=pivot)
        return self._above.marks(self.context).above(marks) if self._above is not None else marks

    def progress(self) -> str:
        """Return how far the gesture in flight has come, as a sentence for the status line."""
        return self.tool.progress(self.context)

    def place(self) -> Vector | None:
        """Return where the point is that is dragged, None while none is."""
        return self._drags.place_at(self._pointer)
