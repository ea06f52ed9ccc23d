"""A tool: what mouse and keys do while it is in use, and the event that comes with each event."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import msgspec
from msgspec.structs import replace

from ..document.model import Vector
from ..document.point_group import points_of
from ..view_model.curve.curve_view import CurveView
from ..view_model.registry import Registry
from .background import Background
from .drag_machine import DragMachine
from .drags import NudgePoints
from .editing_session import EditingSession
from .gesture import Gesture
from .marks import Marks, Note
from .pencil_detail import PencilDetail
from .pointer import Cursor, Hint, Hit, Part, Pointer, Stride
from .snappers import SnapTargets
from .snapping import SnapKind, Snapping, with_snap
from .target import SelectionBox
from .transform_box import TransformBox


class Finder(Protocol):
    """What a tool finds on the canvas besides the curve that is edited."""

    finds_other_curves: bool
    finds_guides: bool
    finds_image: bool


class CanvasQueries:
    """What tools work on: by default nothing lies anywhere.

    A further question is a method here, answered by the plots that know; tools ask ``event.canvas``.
    """

    def hit(self, pointer: Pointer, tool: Finder) -> Hit | None:
        """Return what a tool hits at the pointer."""
        return None

    def locked_at(self, pointer: Pointer) -> int:
        """Return the place of the locked curve at the pointer, which presses go through; −1 for none."""
        return -1

    def grid_spacing(self) -> float:
        """Return the spacing of the grid at the present zoom."""
        return 1.0


class ToolSettings(msgspec.Struct, frozen=True):
    """Settings of the tools, as the person has them.

    Attributes
    ----------
    snapping
        Whether to snap, and to what.
    unit
        The name of the unit of length, for what is measured.
    shows_box
        Whether two or more selected points, or several selected curves, get a box with grips.
    keeps_proportions
        Whether the grips at the corners of that box keep its proportions.
    pencil
        How near a curve comes to what the pencil draws.
    """

    snapping: Snapping = Snapping()
    unit: str = ""
    shows_box: bool = True
    keeps_proportions: bool = False
    pencil: PencilDetail = PencilDetail.MEDIUM


class ToolEvent(msgspec.Struct, frozen=True):
    """One event, with everything that a tool needs to answer it.

    Attributes
    ----------
    pointer
        Position, modifier keys, and what lies under the pointer.
    session
        The session: the document, its views, the selection, and the way to change them.
    settings
        Snapping, the unit, whether there is a box with grips.
    drags
        Begins a drag, follows it, makes it a step of the history.
    snapping
        Makes what a drag snaps with.
    box
        The selected points or curves that transforms act on.
    background
        Does what takes longer than a moment.
    canvas
        The plot: what lies under a pointer, the colour there, the spacing of the grid.
    tool
        The tool in use.
    """

    pointer: Pointer
    session: EditingSession
    settings: ToolSettings
    drags: DragMachine
    snapping: SnapTargets
    box: SelectionBox
    background: Background
    canvas: CanvasQueries
    tool: Tool

    @property
    def hit(self) -> Hit | None:
        """The part of the drawing under the pointer."""
        return self.pointer.hit

    @property
    def view(self) -> CurveView:
        """The curve that is edited."""
        return self.session.active_view

    def grid(self) -> float:
        """Return the spacing of the grid at the present zoom."""
        return self.canvas.grid_spacing()

    def at(self, pointer: Pointer) -> ToolEvent:
        """Return the event of an event somewhere else."""
        return replace(self, pointer=pointer)

    def with_hit(self) -> ToolEvent:
        """Return the event with what lies under the pointer now."""
        hit = self.canvas.hit(self.pointer, self.tool) if self.pointer.is_there else None
        return self.at(replace(self.pointer, hit=hit))

    @property
    def rectangle(self) -> TransformBox | None:
        """The box around the selection, where it is displayed and can be changed; None otherwise."""
        box = self.box.rectangle if self.settings.shows_box else None
        return box if box is not None and not self.box.refusal_of(self.box.group) else None

    def frame_marks(self) -> Marks:
        """Return the marks of the selection while something is dragged: its box without grips, its pivot."""
        if not self.tool.shows_box:
            return Marks()
        box, pivot = self.rectangle, self.box.pivot
        return Marks(frame=box, pivot=pivot or (box.centre if box is not None else None))

    def preview_snap(self, index: int) -> None:
        """Show where a press would put the point of `index`, −1 for none in particular."""
        if self.settings.snapping.on and self.pointer.is_there:
            self.snapping.show_before_press(self.pointer, index)

    def step_of(self, stride: Stride) -> float:
        """Return how far an arrow key goes: a step of the grid that snaps, or a round number."""
        snapping = self.settings.snapping
        grid = self.grid() if snapping.on and SnapKind.GRID in snapping.kinds else None
        return stride.length(grid)

    def progress(self) -> str:
        """Return how far the drag in flight has come, and what it has snapped to."""
        return with_snap(self.drags.progress_at(self.pointer), self.snapping.caught)

    def note(self) -> Note | None:
        """Return the amount of the drag in flight, to stand beside the pointer."""
        text = self.drags.progress_at(self.pointer).partition(" · ")[0]
        return Note(self.pointer.position, text, self.box.centre) if text else None


class OldGesture:
    """A gesture that is no drag, from its press on: it changes nothing in the document."""

    def move(self, event: ToolEvent) -> None:
        """Follow the pointer."""

    def release(self, event: ToolEvent) -> None:
        """End: by default as after one more move."""
        self.move(event)

    def cancel(self, event: ToolEvent) -> None:
        """Bring back what was there before."""

    def progress(self, event: ToolEvent) -> str:
        """Return how far it has come, as a sentence for the status line."""
        return ""


class Tool:
    """A tool of a plot: by default it begins nothing, and follows a drag that it has begun.

    Its own state is that of its gesture; everything else comes with each event. A tool that changes the
    document begins a drag in `press` (``event.drags.press``), and the rest follows from that: threshold,
    preview, one step of the history, Escape.

    Attributes
    ----------
    cursor
        The shape of the pointer where a press means nothing in particular.
    finds_other_curves, finds_guides, finds_image
        Whether other curves than the one that is edited can be hit; whether guides can; whether nothing but
        the picture can.
    shows_new_handle
        Whether the selected point shows the handle that a press there would pull out.
    lasts_one_gesture
        Whether it gives way to the tool below it when its gesture has ended.
    gesture
        What is in flight and no drag; None for nothing.
    """

    cursor = Cursor.CROSS
    finds_other_curves = False
    finds_guides = False
    finds_image = False
    shows_new_handle = False
    lasts_one_gesture = False
    shows_box = False
    gesture: OldGesture | None = None

    # Events

    def press(self, event: ToolEvent) -> Gesture | None:
        """Return the gesture that begins here."""
        return None

    def move(self, event: ToolEvent) -> None:
        """Follow the pointer while a gesture is in flight."""
        if self.gesture is not None:
            self.gesture.move(event)
        else:
            event.drags.move(event.pointer)

    def release(self, event: ToolEvent) -> None:
        """End the gesture."""
        if self.gesture is not None:
            self.gesture.release(event)
        else:
            event.drags.release(event.pointer)

    def hover(self, event: ToolEvent) -> Hint:
        """Return what a press here would do."""
        return Hint()

    def key(self, event: ToolEvent, key: str) -> bool:
        """Take a key, such as "enter" or "x"; return whether it meant something."""
        return False

    def claims(self, event: ToolEvent, key: str) -> bool:
        """Whether a key is for the tool that would be a shortcut otherwise."""
        return False

    def nudge(self, event: ToolEvent, direction: Vector, stride: Stride) -> bool:
        """Move the selected points, or curves, by a step of the grid or, not snapping, of a round number.

        Return whether the arrow key meant something.
        """
        group = event.box.group
        if group is None:
            return True
        step = event.step_of(stride)
        drag = NudgePoints(event.session.document, group, (direction[0] * step, direction[1] * step))
        event.drags.nudge(drag, ("points", group))
        return True

    def walk(self, event: ToolEvent, step: int) -> bool:
        """Select the next (1) or previous (−1) point of the curves that are edited; return whether one is."""
        session = event.session
        order = [
            (curve, index)
            for curve in sorted(session.selected.edited)
            for index in range(len(session.document.curves[curve].points))
        ]
        points, active = session.selected.points, session.active_index
        if points:
            place = order.index((active, max(points) if step > 0 else min(points))) + step
        else:
            # The first of the active curve, or its last.
            own = [place for place, (curve, _) in enumerate(order) if curve == active]
            place = own[0 if step > 0 else -1] if own else -1
        if not 0 <= place < len(order):
            return False
        curve, index = order[place]
        session.selected.set_group(points_of(curve, [index]))
        return True

    def cancel(self, event: ToolEvent) -> None:
        """Take the gesture in flight back."""
        if self.gesture is not None:
            self.gesture.cancel(event)
        event.drags.cancel()

    def pick_up(self) -> None:
        """Begin to be used, in place of another tool."""

    def takes_up(self, event: ToolEvent) -> bool:
        """Whether it works on the active curve where none is edited."""
        return not self.finds_other_curves

    def take_over(self, event: ToolEvent) -> None:
        """Begin to be used while no curve was edited: what is drawn from now on is another one."""

    def end(self) -> None:
        """Drop what belongs to one gesture: it has ended, or another begins."""
        self.gesture = None

    def dismiss(self, event: ToolEvent) -> bool:
        """Remove what was left on the plot; return whether there was something."""
        return False

    def reset(self) -> None:
        """Forget everything; another document is open."""

    # What is shown meanwhile

    def lit(self, hit: Hit | None) -> int:
        """Return the point that lights up with what lies under the pointer, −1 for none."""
        return hit.index if hit is not None and hit.part is Part.POINT else -1

    def marks(self, event: ToolEvent) -> Marks:
        """Return what is drawn over the plot."""
        return Marks(snap=event.snapping.caught)

    def progress(self, event: ToolEvent) -> str:
        """Return how far the gesture in flight has come, as a sentence for the status line."""
        return self.gesture.progress(event) if self.gesture is not None else event.progress()


class GestureRow(msgspec.Struct, frozen=True):
    """A row of the sheet of keys and mouse: a gesture in words, and what must be there for it.

    Attributes
    ----------
    keys, what
        How it is made, and what it does.
    selected, curves
        Whether it is done to selected points; to curves that are chosen as wholes.
    needs_derivatives
        Whether the points need velocities.
    """

    keys: str
    what: str
    selected: bool = False
    curves: bool = False
    needs_derivatives: bool = False


class ToolRecord(msgspec.Struct, frozen=True, kw_only=True):
    """A tool as it is selected.

    Attributes
    ----------
    name
        Its name in the program.
    make
        Makes the tool of one plot.
    hint
        What the status line says when it has been selected.
    beginning
        What the canvas says while it is empty; empty where another tool has to be chosen first.
    doing, gestures
        What a person does who uses it, such as "measuring", and how: what the sheet of keys and mouse says.
    rank
        Where it stands among the tools of menu and toolbar.
    action, title, full_name, key, icon, tip
        What the action has by which it is selected: object name, text in a menu and where no menu stands
        around it, keys, icon, tooltip. Empty where a feature has an action of its own for it.
    in_menu, in_toolbar
        Whether the menu of the canvas offers it; whether it has a button of its own in the toolbar, and does
        not stand in the menu of the further ones there.
    keywords
        Other words by which the palette finds it.
    """

    name: str
    make: Callable[[], Tool]
    hint: str
    beginning: str = ""
    doing: str = ""
    gestures: tuple[GestureRow, ...] = ()
    rank: int = 1000
    action: str = ""
    title: str = ""
    full_name: str = ""
    key: str = ""
    icon: str = ""
    tip: str = ""
    in_menu: bool = False
    in_toolbar: bool = True
    keywords: str = ""

    @property
    def sort_key(self) -> tuple[int, ...]:
        """The key by which records are sorted in menus and panels."""
        return (self.rank,)


TOOLS = Registry(ToolRecord, f"{__package__}.canvas")
"""The tools that a person chooses for the canvas.

To add one: a file in ``canvas`` with a subclass of `Tool` and its `ToolRecord`. The action with its key and
its place in menus and palette, the way back by Escape and the rows of the sheet of keys and mouse come from
the record.
"""
