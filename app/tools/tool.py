"""The protocol of the tools: `Tool.press` returns a `Gesture`; a `Drag` is one that changes the document.

A tool is a class and a record in a file of ``canvas``. This one puts points above the press:

    # app/tools/canvas/lift.py
    from __future__ import annotations

    from ...document import words
    from ...document.model import Document, Vector
    from ...view_model.append import with_point_appended
    from ...view_model.curve.curve_view import CurveView
    from ..pointer import Hint, Pointer
    from ..tool import Drag, Gesture, GestureRow, Tool, ToolEvent, ToolRecord

    class Lift(Drag, kw_only=True):
        curve: int
        view: CurveView
        foot: Vector

        def head(self, pointer: Pointer) -> Vector:
            return (self.foot[0], pointer.position[1])

        def document_at(self, pointer: Pointer) -> Document:
            return with_point_appended(self.document, self.curve, self.view, self.head(pointer))

        def undo_text(self, pointer: Pointer) -> str:
            return "Lift point"

        def amount(self, pointer: Pointer) -> str:
            return f"Point at {words.pair_text(self.head(pointer))}"

    class LiftTool(Tool):
        def press(self, event: ToolEvent) -> Gesture:
            session = event.session
            return Lift(
                document=session.document,
                curve=session.active_index,
                view=event.view,
                foot=event.pointer.position,
            )

        def hover(self, event: ToolEvent) -> Hint:
            return Hint("Drag to put a point above where you pressed")

    LIFT = ToolRecord(
        name="lift",
        make=LiftTool,
        hint="Drag upwards.",
        doing="lifting points",
        gestures=(GestureRow("Drag", "put a point above where you pressed"),),
        action="liftTool",
        title="Lift",
        tip="Put points above where you press",
    )

Threshold, preview, undo step and Escape follow from that. The status line shows `amount` during the drag, and
the sheet of keys and mouse has a row for each of the `gestures`.

A setting of the tool, such as ``DETAIL`` in ``canvas/pencil``, stands in the record (``settings=(DETAIL,)``);
the tool, or its gesture, reads it with ``event.value(DETAIL)``. Its field in the preferences and its key in
the file of settings follow. The kinds are in ``app/view_model/settings.py``: `SwitchSetting` (a check box),
`Count` (a whole number, a spin box) and `ChoiceSetting` (a box, and an action for each member).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cached_property
from typing import ClassVar

import msgspec
from msgspec.structs import replace

from ..document.fields import NO_SCROLL, Scroll
from ..document.limits import EditError
from ..document.model import Document, Vector
from ..document.point_group import NO_POINTS, PointGroup
from ..document.selection import SelectionState
from ..document.transforms import round_step_above
from ..document.words import decimal_product
from ..view_model.curve.curve_view import CurveView
from ..view_model.registry import Registry
from ..view_model.settings import OwnedSetting, SettingValues, ToolSetting, Value_co
from .background import Background
from .box import SelectionBox, TransformBox
from .editing_session import EditingSession
from .marks import Marks
from .nudge import DIRECTIONS, nudge, select_next
from .pointer import Cursor, Hint, Hit, Part, Pointer
from .snapping import SnapKind, SnapTargets
from .typed_amount import TypedAmount

THRESHOLD = 3.0
"""Pixels the pointer must travel before a press becomes a drag."""

CANCELLED = "Cancelled."
"""Message after Escape has ended a gesture."""

_LEAST_PIXELS = 2.0
"""Pixels of a step by an arrow key, at least; the round number is at most two and a half times as far."""


class CanvasQueries:
    """Questions of a tool to its plot, as `event.canvas`; by default nothing lies anywhere.

    A further question is a method here, answered by the plots that know.
    """

    def hit(self, pointer: Pointer, parts: frozenset[Part]) -> Hit | None:
        """Return the part of the drawing at the pointer, of those that a tool hits."""
        return None

    def locked_at(self, pointer: Pointer) -> int:
        """Return the index of the locked curve at the pointer, which presses pass through; −1 for none."""
        return -1

    def grid_spacing(self) -> float:
        """Return the spacing of the grid at the present zoom."""
        return 1.0

    def shows_curves(self, indices: Iterable[int]) -> bool:
        """Whether the curves at these indices are inside the visible part of the plane."""
        return True

    def scroll_of_drag(self) -> Scroll:
        """Return the parts of the plane visible before the drag and now, where it has scrolled the view."""
        return NO_SCROLL


class ToolEvent(msgspec.Struct, frozen=True, dict=True):
    """One press, move, hover or key, with everything that a tool needs to answer it.

    Attributes
    ----------
    pointer
        Position and modifier keys.
    session
        Document, views and selection, and the methods that change them.
    settings
        Settings of all tools: `event.value(DETAIL)` is the value of one.
    snapping
        Whether and to what to snap; makes the snapper of a gesture.
    box
        The box around the selection, and its pivot.
    background
        Does work that takes longer than a moment.
    canvas
        The plot: what lies under a pointer, the spacing of the grid.
    tool
        The tool in use.
    hit
        The part of the drawing under the pointer, for a press and a hover.
    """

    pointer: Pointer
    session: EditingSession
    settings: SettingValues
    snapping: SnapTargets
    box: SelectionBox
    background: Background
    canvas: CanvasQueries
    tool: Tool
    hit: Hit | None = None

    @property
    def view(self) -> CurveView:
        """The view of the active curve."""
        return self.session.active_view

    @cached_property
    def rectangle(self) -> TransformBox | None:
        """The box around the selection, where it is drawn and nothing in it is locked; None otherwise."""
        return self.box.visible_rectangle

    def value(self, setting: OwnedSetting[Value_co]) -> Value_co:
        """Return the value of a setting of the tool."""
        return self.settings.value(setting)

    def at(self, pointer: Pointer) -> ToolEvent:
        """Return the event of a pointer somewhere else."""
        return replace(self, pointer=pointer, hit=None)

    def with_hit(self) -> ToolEvent:
        """Return the event with the part of the drawing that is under the pointer now."""
        hit = self.canvas.hit(self.pointer, self.tool.hits) if self.pointer.is_there else None
        return replace(self, hit=hit)

    def frame_marks(self) -> Marks:
        """Return the marks of the selection while something is dragged: its box without grips, its pivot."""
        if not self.tool.shows_box:
            return Marks()
        box, pivot = self.rectangle, self.box.pivot
        return Marks(frame=box, pivot=pivot or (box.centre if box is not None else None))

    def preview_snap(self, index: int) -> None:
        """Preview the snap of a point that a press would add at an index, −1 for none in particular."""
        if self.snapping.is_on and self.pointer.is_there:
            self.snapping.show_before_press(self.pointer, index)

    def key_step(self, *, on_grid: bool = True) -> float:
        """Return the step of an arrow key: a step of the grid that snaps, or a round number.

        With Shift ten times as far, with Ctrl a tenth; it is a short decimal number each time.
        """
        if on_grid and self.snapping.is_on and SnapKind.GRID in self.snapping.settings.kinds:
            step = self.canvas.grid_spacing()
        else:
            step = round_step_above(_LEAST_PIXELS / self.pointer.scale)
        factor = (10.0 if self.pointer.shift else 1.0) * (0.1 if self.pointer.ctrl else 1.0)
        return decimal_product(step, factor)


class Gesture(msgspec.Struct, kw_only=True):
    """The reaction to the mouse from a press to the release; the tool in use returns it.

    Escape calls `cancel`; three pixels make a drag of a click. Data of the press are fields, so that `click`,
    `move` and `release` read in order of time.

    Attributes
    ----------
    starts_at_press
        Whether it moves from the press on, and is never a click: the pen, whose effect is visible at once.
    follows_click
        Whether it goes on after a click, follows the pointer without a button, and ends with the next one.
    scrolls_view
        Whether the view moves on where the pointer comes to the edge.
    on_click
        The effect of a click; None for none.
    pressed_at, has_moved
        Pixel of the press; whether the pointer has travelled far enough for a drag. The toolbox sets them.
    """

    starts_at_press: ClassVar[bool] = False
    follows_click: ClassVar[bool] = False
    scrolls_view: ClassVar[bool] = True
    on_click: Callable[[ToolEvent], object] | None = None
    pressed_at: Vector = (0.0, 0.0)
    has_moved: bool = False

    def click(self, event: ToolEvent) -> None:
        """End where the press was: it is a click."""
        if self.on_click is not None:
            self.on_click(event)

    def move(self, event: ToolEvent) -> None:
        """Follow the pointer."""

    def release(self, event: ToolEvent) -> None:
        """End; the last move has been made."""

    def cancel(self, event: ToolEvent) -> None:
        """Say that the gesture is cancelled; the toolbox has restored document and selection.

        A gesture that has changed more restores that here.
        """
        event.session.say(CANCELLED)

    def wants_key(self, key: str) -> bool:
        """Return whether a key is for the gesture that would be a shortcut otherwise; "enter" releases."""
        return False

    def key(self, event: ToolEvent, key: str) -> bool:
        """Take a key: a typed digit, an axis. Return whether it had an effect; a move follows then."""
        return False

    def status(self, event: ToolEvent) -> str:
        """Return the sentence for the status line, asked at most every 33 ms."""
        return ""

    def marks(self, event: ToolEvent) -> Marks:
        """Return the marks over the plot: by default the frame around the selection."""
        return event.frame_marks()

    def position_at(self, pointer: Pointer) -> Vector | None:
        """Return the position of the point that is dragged, for the coordinates in the status line."""
        return None


class Drag(Gesture, kw_only=True):
    """A gesture that changes the document: previewed at each move, one undo step at the release.

    Attributes
    ----------
    document
        The document at the press; every move computes another one from it, never from the last move.
    selects
        Selection from the first preview on. Escape restores the one before; undo restores it only where it
        brings back curves of it, or removes all curves selected since (`Selection.select_returned`).
    refusal
        Why the last move changed nothing; empty where it did.
    group
        The points that the drag changes together; none of a drag that changes something else.
    keys
        Effects of the modifier keys. A subclass overrides them by a property, or where they are always the
        same by a value in its body: ``keys = AXIS_KEYS``.
    """

    document: Document
    selects: SelectionState | None = None
    refusal: str = ""
    group: PointGroup = NO_POINTS

    @property
    def keys(self) -> str:
        """Effects of the modifier keys, for the status line."""
        return ""

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the pointer there. An EditError keeps the last good one.

        It is pure, but for the snapper, which remembers its last answer.
        """
        raise NotImplementedError

    def undo_text(self, pointer: Pointer) -> str:
        """Return the name of the step in the history, such as "Move point 2"."""
        raise NotImplementedError

    def amount(self, pointer: Pointer) -> str:
        """Return the amount of the drag, such as "Rotate 30°"; empty for none."""
        return ""

    def move(self, event: ToolEvent) -> None:
        """Preview the document at the pointer, or say why it cannot be."""
        try:
            document = self.document_at(event.pointer)
        except EditError as reason:
            self.refusal = str(reason)
            event.session.refuse(self.refusal)
            return
        self.refusal = ""
        event.session.preview(document, selects=self.selects)

    def release(self, event: ToolEvent) -> None:
        """Make the previewed document a step; where the last move was refused, it is the last good one."""
        session = event.session
        text, scroll = self.undo_text(event.pointer), event.canvas.scroll_of_drag()
        if session.commit(session.document, text, scroll=scroll):
            self.committed(event)
        if self.refusal:
            session.refuse(self.refusal)

    def committed(self, event: ToolEvent) -> None:
        """Say the remark, after the step has been made."""
        if self.group.remark:
            event.session.say(f"{self.group.remark}.")

    def status(self, event: ToolEvent) -> str:
        """Return the amount, the remark and the keys; or why nothing changes."""
        amount = self.amount(event.pointer)
        if self.refusal or not amount:
            return self.refusal
        return " · ".join(filter(None, (amount, self.group.remark, self.keys, "Escape cancels")))

    def marks(self, event: ToolEvent) -> Marks:
        """Return the frame around the selection, and the snap of the drag."""
        return replace(super().marks(event), snap=event.snapping.caught)


class TypedDrag(Drag, kw_only=True):
    """A drag whose amount can be typed meanwhile.

    Attributes
    ----------
    typed
        The amount as typed so far; the pointer gives it while this is empty.
    """

    typed: TypedAmount = TypedAmount()

    def wants_key(self, key: str) -> bool:
        """Return whether a key is for the amount."""
        return key in ("enter", "tab") or self.typed.claims(key)

    def key(self, event: ToolEvent, key: str) -> bool:
        """Take a character of the amount, or "tab" to the other number of two."""
        if key != "tab":
            return self.type(key)
        self.typed = self.typed.after_tab(None)
        return True

    def type(self, key: str) -> bool:
        """Take a character of the amount; return whether it had an effect.

        Raises
        ------
        EditError
            For a letter that is none of a unit, and for "enter" while the amount is no number yet.
        """
        if key == "enter" and self.typed.refusal:
            raise EditError(self.typed.refusal)
        typed = self.typed.after(key)
        if typed is None:
            return False
        self.typed = typed
        return True

    def release(self, event: ToolEvent) -> None:
        """Make the previewed document a step, unless the amount is no number yet."""
        if refusal := self.typed.refusal:
            event.session.cancel()
            event.session.refuse(refusal)
        else:
            super().release(event)


class Refusal(Gesture, kw_only=True):
    """Drag of a locked curve: it says why nothing moves; a click is a click."""

    reason: str

    def move(self, event: ToolEvent) -> None:
        """Say why nothing moves."""
        event.session.refuse(self.reason)

    def status(self, event: ToolEvent) -> str:
        """Return the reason."""
        return self.reason


class Tool:
    """A tool of a plot: `press` returns the gesture that a press begins, `hover` says so in advance.

    Every method has a default; most tools have `press` and `hover`. The state of a gesture belongs to the
    gesture; a tool keeps what outlives it, such as a ruler that stays.

    Attributes
    ----------
    cursor
        The shape of the pointer where a press means nothing in particular.
    hits
        The parts of the drawing that a press can hit.
    edits_points
        Whether the active curve is edited while the tool is in use.
    shows_box, shows_new_handle
        Whether the box around the selection is drawn; whether the selected point shows the handle that a
        press there would pull out.
    """

    cursor = Cursor.CROSS
    hits: frozenset[Part] = frozenset({Part.POINT, Part.HANDLE, Part.CURVE})
    edits_points = True
    shows_box = False
    shows_new_handle = False

    def press(self, event: ToolEvent) -> Gesture | None:
        """Return the gesture that begins here; None for nothing."""
        return None

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint: the effect of a press here."""
        return Hint()

    def key(self, event: ToolEvent, key: str) -> bool:
        """Take a key, such as "enter", "left" or "x", while no gesture is in flight; return whether it did.

        By default the arrows move the selected points, or curves, by a step of the grid or a round number;
        "next" and "previous" (Tab) select another point.
        """
        if key in DIRECTIONS:
            group, (x, y), step = event.box.group, DIRECTIONS[key], event.key_step()
            if group is not None:
                nudge(event.session, group, (x * step, y * step))
            return True
        return key in ("next", "previous") and select_next(event.session, 1 if key == "next" else -1)

    def wants_key(self, event: ToolEvent, key: str) -> bool:
        """Return whether a key is for the tool that would be a shortcut otherwise."""
        return False

    def marks(self, event: ToolEvent) -> Marks:
        """Return the marks over the plot while no gesture is in flight."""
        return Marks(snap=event.snapping.caught)

    def activate(self, event: ToolEvent) -> None:
        """Begin to be used, in place of another tool."""

    def deactivate(self, event: ToolEvent) -> None:
        """End being used: another tool is chosen."""
        self.dismiss(event)

    def dismiss(self, event: ToolEvent) -> bool:
        """Remove the marks that a gesture has left on the plot; return whether there were any."""
        return False


class GestureRow(msgspec.Struct, frozen=True):
    """A row of the sheet of keys and mouse: a gesture in words, and its conditions.

    Attributes
    ----------
    keys, what
        How it is made, and what it does.
    selected, curves
        Whether it needs selected points; curves that are selected as wholes.
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
        Its name in the program, and in the keys under which its settings are stored.
    make
        Makes the tool of one plot.
    hint
        The message in the status line after it was chosen.
    empty_message
        The message on an empty canvas; empty where another tool has to be chosen first.
    doing, gestures
        What a person does who uses it, such as "measuring", and how: what the sheet of keys and mouse says.
    rank
        Where it stands among the tools of menu and toolbar.
    action, title, full_name, key, icon, tip
        What the action has by which it is selected: object name, text in a menu and where no menu stands
        around it, keys, icon, tooltip. Empty where a feature has an action of its own for it.
    in_menu, in_toolbar
        Whether the menu of the canvas offers it; whether it has a button of its own in the toolbar, which has
        room for few, instead of an entry in the menu of the further ones there.
    keywords
        Other words by which the palette finds it.
    settings
        Its settings: each has a field in the preferences, a choice of few also an action for each member.
    """

    name: str
    make: Callable[[], Tool]
    hint: str
    empty_message: str = ""
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
    in_toolbar: bool = False
    keywords: str = ""
    settings: tuple[ToolSetting, ...] = ()

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
