"""The tools of the canvas: which gesture a press begins, and what a press here would do."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum

from msgspec.structs import replace

from app.document.model import Vector
from app.document.several_curves import nodes_of
from app.tools import hints, words
from app.tools.bend_drag import BendCurve
from app.tools.choosing import Choosing
from app.tools.closing import can_end_at, closer
from app.tools.drags import DragHandle, MovePoints, PullVelocity, Refuse
from app.tools.machine import Drag, DragMachine, Host
from app.tools.magnets import Magnets
from app.tools.marquee import Marquee
from app.tools.measure import KEYS, Measure
from app.tools.overlay import Note, Overlay
from app.tools.pen import Pen
from app.tools.pointer import Hint, Hit, Part, Pointer
from app.tools.snapping import Magnet, SnapKind, Snapping
from app.tools.subject import Subject
from app.tools.transform import ModalTransform, TransformKind
from app.tools.transform_box import Grip, TransformBox

_KEYS = {TransformKind.MOVE: "g", TransformKind.SCALE: "s", TransformKind.ROTATE: "r"}
"""What begins each transform goes on with it where another one is in flight."""


class ToolKind(Enum):
    """What a press on the canvas means."""

    SELECT = "select"
    ADD = "add"
    MEASURE = "measure"
    EXPLAIN = "explain"


class CanvasTool:
    """The canvas's gestures: Select, Add points or Measure, and the transforms that keys begin.

    Attributes
    ----------
    snapping
        Whether to snap, and to what.
    grid
        The spacing of the grid along x and y; the canvas keeps it in step with the zoom.
    shows_box
        Whether two or more selected points, or several chosen curves, get a box with grips.
    unit
        The name of the unit of length, for what is measured.
    pen
        What the Add tool does.
    """

    def __init__(self, host: Host) -> None:
        self._host = host
        self._machine = DragMachine(host)
        self._modal = ModalTransform(host, self._machine)
        self._magnets = Magnets(host, lambda: self.snapping, lambda: self.grid)
        self._subject = Subject(host, self._magnets)
        self._choosing = Choosing(host, self._machine, self._subject)
        self.pen = Pen(host, self._machine, self._magnets)
        self._marquee: Marquee | None = None
        self._measure: Measure | None = None
        self._measuring = False
        self._note_wanted = False
        self._last: Pointer | None = None
        self.kind = ToolKind.SELECT
        self.snapping = Snapping()
        self.grid: Vector = (1.0, 1.0)
        self.shows_box = True
        self.unit = ""

    @property
    def is_pressed(self) -> bool:
        """Whether a gesture is in flight."""
        return self._machine.is_pressed or self._marquee is not None or self._measuring

    @property
    def is_modal(self) -> bool:
        """Whether a transform follows the pointer with no button down."""
        return self._modal.now is not None

    def enter(self, pointer: Pointer) -> bool:
        """Edit another curve that is pressed, before `press`; return whether another thing lies there now."""
        self._choosing.entered = ""
        return self.kind is ToolKind.SELECT and not self.is_modal and self._choosing.enter(pointer)

    def press(self, pointer: Pointer) -> None:
        """Begin a gesture, or end the one that keys began."""
        self._last = pointer
        if self.is_modal:
            self._modal.finish(pointer)
            self._end()
            return
        self._end()
        hit, grip = pointer.hit, self._grip_at(pointer)
        if self.kind is ToolKind.MEASURE:
            self._measure, self._measuring = (
                Measure(pointer, self._magnets.for_points((), -1), self.unit),
                True,
            )
        elif self.kind is ToolKind.EXPLAIN:
            self._explain(hit)
        elif hit is not None and hit.part is Part.OTHER_CURVE:
            self._choosing.press(pointer, hit)
        elif hit is not None and hit.part is not Part.CURVE:
            self._press_on_part(pointer, hit)
        elif self.kind is ToolKind.ADD:
            self.pen.press(pointer)
        elif grip is not None:
            self._press_on_grip(pointer, *grip)
        elif hit is not None:
            self._press_on_curve(pointer, hit)
        elif self._choosing.entered:
            # At the very edge of reach, beside the curve that this press has made the one edited.
            self._machine.press(pointer, None)
        else:
            self._marquee = Marquee(self._host, pointer, self._choosing.choose_none)

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        self._last = pointer
        if self.is_modal:
            self._modal.follow(pointer)
        elif self._marquee is not None:
            self._marquee.move(pointer)
        elif self._measuring and self._measure is not None:
            self._measure.move(pointer)
        else:
            self._machine.move(pointer)

    def release(self, pointer: Pointer) -> None:
        """End the gesture."""
        if self._marquee is not None:
            self._marquee.release(pointer)
        elif self._measuring and self._measure is not None:
            self._measure.move(pointer)
        else:
            self._machine.release(pointer)
        self._end()

    def cancel(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        was_pressed = self.is_pressed
        if self._marquee is not None:
            self._marquee.cancel()
        if self._measuring:
            self._measure = None
        self._machine.cancel()
        self._end()
        return was_pressed

    def forget(self) -> None:
        """Drop the gesture in flight; the document is somebody else's now."""
        self._machine.forget()
        self._end()

    def put_away(self) -> bool:
        """Put away what was measured; return whether there was something."""
        measured, self._measure = self._measure, None
        return measured is not None

    def _end(self) -> None:
        self._modal.drop()
        self._marquee = None
        self._magnets.drop()
        self.pen.look_away()
        self._measuring = self._note_wanted = False

    # What is shown meanwhile

    def progress(self) -> str:
        """Return how far the gesture in flight has come, as a sentence for the status line."""
        if self._marquee is not None:
            return self._marquee.progress() if self._marquee.band is not None else ""
        if self._measuring and self._measure is not None:
            return self._with_snap(self._measure.progress(), self._measure.magnet)
        if self._last is None:
            return ""
        return self._with_snap(self._machine.progress_at(self._last), self._magnets.now)

    def place(self) -> Vector | None:
        """Return where the point is that is dragged, None while none is."""
        return self._machine.place_at(self._last) if self._last is not None else None

    @staticmethod
    def _with_snap(text: str, magnet: Magnet | None) -> str:
        caught = magnet.caught if magnet is not None else None
        return f"{text} · snapped to: {caught.label}" if caught is not None and text else text

    def overlay(self) -> Overlay:
        """Return what is shown over the drawing."""
        measured, magnet = self._measure, self._magnets.now
        if measured is not None:
            magnet = measured.magnet if self._measuring else None
        return Overlay(
            band=self._marquee.band if self._marquee is not None else None,
            box=None if self.is_pressed else self._box(),
            snap=magnet.caught if magnet is not None else None,
            ruler=measured.ruler if measured is not None and measured.is_something else None,
            note=self._note(),
            axis=self._locked_axis(),
            ahead=self.pen.ahead if not self.is_pressed else None,
            spot=self.pen.spot if not self.is_pressed else None,
        )

    def _note(self) -> Note | None:
        if not self._note_wanted or self._last is None:
            return None
        text = self._machine.progress_at(self._last).partition(" · ")[0]
        return Note(self._last.position, text, self._subject.centre) if text else None

    def _locked_axis(self) -> tuple[Vector, int] | None:
        now = self._modal.now
        is_locked = now is not None and now.axis is not None and now.kind is not TransformKind.ROTATE
        return (now.centre, now.axis) if now is not None and now.axis is not None and is_locked else None

    def _box(self) -> TransformBox | None:
        if not self.shows_box or self.kind is not ToolKind.SELECT:
            return None
        return self._subject.box if not self._subject.refusal else None

    def _grip_at(self, pointer: Pointer) -> tuple[TransformBox, Grip] | None:
        return self._subject.grip_at(pointer) if self._box() is not None else None

    # Transforms

    def begin_transform(self, kind: TransformKind, pointer: Pointer) -> bool:
        """Let the selected points, or the chosen curves, follow the pointer with no button down.

        With nothing selected or chosen it acts on all points of the curve that is edited. Return False if
        there are none, or one of the curves is locked.
        """
        if self.is_modal:
            return self._modal.key(_KEYS[kind])
        if self.is_pressed:
            return False
        if refusal := self._subject.refusal_of_keys:
            self._host.refuse(refusal)
            return False
        transform = self._subject.transform(kind, pointer)
        self._note_wanted, self._last = True, pointer
        self._modal.begin(transform, pointer)
        return True

    def transform_key(self, key: str) -> bool:
        """Give the transform in flight a key; return whether it knew what to do with it."""
        taken = self._modal.key(key)
        if taken and not self.is_modal:
            self._end()
        return taken

    def _press_on_grip(self, pointer: Pointer, box: TransformBox, grip: Grip) -> None:
        self._note_wanted = True
        if grip.rotates:
            transform = self._subject.transform(TransformKind.ROTATE, pointer)
            self._machine.press(pointer, replace(transform, by_grip=True))
            return
        self._machine.press(pointer, self._subject.scaling(box, grip, pointer))

    def walk(self, step: int) -> bool:
        """Select the next (1) or previous (−1) point; return whether there is one."""
        host = self._host
        count = len(host.active_view.source.nodes)
        here = max(host.selection) if host.selection and step > 0 else min(host.selection, default=count)
        index = here + step if host.selection or step < 0 else 0
        if not 0 <= index < count:
            return False
        host.select([index])
        return True

    def nudge(self, direction: Vector, pixel: float, factor: float = 1.0) -> None:
        """Move the selected points, or the chosen curves, by a step of the grid or, not snapping, a pixel."""
        group = self._subject.group
        if group is None:
            return
        by: Vector = (direction[0] * pixel * factor, direction[1] * pixel * factor)
        snaps = self.snapping.on and SnapKind.GRID in self.snapping.kinds
        drag = self._subject.by_key(direction, self.grid if snaps else None, factor)
        self._machine.nudge(Pointer(by, (0.0, 0.0)), drag, ("points", group))

    def hover(self, pointer: Pointer) -> Hint:
        """Return what a press here would do."""
        hit = pointer.hit
        self._host.set_hovered(hit.index if hit is not None and hit.part is Part.POINT else -1)
        self._preview_snap(pointer)
        if self.kind is ToolKind.ADD:
            self.pen.look_ahead(pointer, self._magnets.now)
        if self.kind is ToolKind.MEASURE:
            return Hint(f"Drag to measure a distance and an angle · {KEYS} · V goes back to Select")
        if self.kind is ToolKind.EXPLAIN:
            return Hint(
                "Click on the curve where it swings out · V goes back to Select", grab=hit is not None
            )
        if hit is not None and hit.part is Part.OTHER_CURVE:
            return self._choosing.hint(hit)
        grip, adding = self._grip_at(pointer), self.kind is ToolKind.ADD
        group, idle = self._subject.group, self._choosing.idle_hint()
        if grip is not None and group is not None and (hit is None or hit.part is Part.CURVE):
            return hints.on_grip(grip[1], group, self._subject.refusal)
        if hit is None and not adding and idle is not None:
            return idle
        return hints.hint_at(
            hit,
            self._host.active_view,
            self._host.selection,
            adding=adding,
            snaps=self.snapping.on,
            shift=pointer.shift,
            finished=adding and self.pen.is_finished,
        )

    def _preview_snap(self, pointer: Pointer) -> None:
        """Show where a press would put something, while a tool would put something."""
        place = self.pen.place_of_new(pointer) if self.kind is ToolKind.ADD else -1
        puts = self.kind is ToolKind.MEASURE or (self.kind is ToolKind.ADD and place is not None)
        if (
            place is None
            or not puts
            or not self.snapping.is_active(pointer)
            or not math.isfinite(pointer.position[0])
        ):
            self._magnets.drop()
            return
        self._magnets.show_before_press(pointer, place)

    def _explain(self, hit: Hit | None) -> None:
        """Put the scrub line where the curve was clicked: what explains the curve stands there."""
        if hit is not None and hit.part is Part.CURVE:
            self._host.set_scrub(hit.t)
        elif hit is not None and hit.part is Part.OTHER_CURVE:
            self._host.activate(hit.index)
        else:
            self._host.refuse("Click on the curve itself, where it swings out.")

    def _press_on_part(self, pointer: Pointer, hit: Hit) -> None:
        host = self._host
        if hit.part is Part.POINT:
            click = self._select_at_press(pointer, hit.index)
            if self.kind is ToolKind.ADD and can_end_at(hit, host.active_view):
                click = closer(host)
            elif self.kind is ToolKind.ADD and self.pen.goes_on_at(hit):
                click = self.pen.go_on
            drag = self._unless_locked(self._point_drag(pointer, hit))
            self._machine.press(pointer, drag, on_click=click)
            return
        magnet = self._magnets.for_handle(hit.index)
        handle = DragHandle(host.document, host.active_index, host.active_view, hit, pointer.position, magnet)
        # A drag drags the handle; a click means what lies below it, for a click does nothing to a handle.
        below = self._click_on(pointer, hit.over) if hit.over >= 0 else None
        self._machine.press(pointer, self._unless_locked(handle), below)

    def _unless_locked(self, drag: Drag) -> Drag:
        source = self._host.active_view.source
        return Refuse(hints.LOCKED.format(source.name)) if source.locked else drag

    def _click_on(self, pointer: Pointer, index: int) -> Callable[[], None]:
        """Return what a click selects: a point alone, or with Shift added to the others or taken away."""
        before = self._host.selection
        return lambda: self._host.select(before ^ {index} if pointer.shift else [index])

    def _select_at_press(self, pointer: Pointer, index: int) -> Callable[[], None]:
        """Select so that a drag moves what it should; return what a click would select."""
        host, before = self._host, self._host.selection
        if index not in before:
            # Alone, for a drag with Shift moves this point along an axis; only a click adds it to the others.
            click = self._click_on(pointer, index)
            host.select([index])
            return click
        return self._click_on(pointer, index)

    def _press_on_curve(self, pointer: Pointer, hit: Hit) -> None:
        host = self._host
        x, y = hit.position
        said = self._choosing.entered or f"t = {words.number(hit.t)} · c(t) = ({words.vector((x, y))})"
        bend = BendCurve(host.document, host.active_index, host.active_view, hit, pointer.position)
        self._machine.press(pointer, self._unless_locked(bend), on_click=lambda: host.say(said))

    def _point_drag(self, pointer: Pointer, hit: Hit) -> MovePoints | PullVelocity:
        host = self._host
        if pointer.alt and host.active_view.source.family.derivatives:
            pulled = self._magnets.for_handle(hit.index)
            return PullVelocity(host.document, host.active_index, host.active_view, hit.index, pulled)
        magnet = self._magnets.for_points(host.selection, hit.index)
        group, grip = nodes_of(host.active_index, host.selection), (host.active_index, hit.index)
        return MovePoints(host.document, group, pointer.position, magnet, grip)
