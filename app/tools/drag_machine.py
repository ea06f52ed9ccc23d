"""State machine of all drags: threshold, preview, commit, cancel."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable

import msgspec

from ..document.limits import EditError
from ..document.model import Document, Vector
from .drag import Drag
from .editing_session import EditingSession
from .gesture import CANCELLED, THRESHOLD
from .pointer import ORIGIN, Pointer


class _Press(msgspec.Struct):
    pixel: Vector
    drag: Drag | None
    on_click: Callable[[], None] | None
    moving: bool
    last: Document | None = None
    refused: str = ""
    on_done: Callable[[], None] | None = None
    active: int | None = None
    makes: int | None = None
    followed: Pointer | None = None
    chooses: frozenset[int] = frozenset()
    shows_choice: bool = False


class DragMachine:
    """State machine that turns press, move and release into preview, commit and cancel.

    A press becomes a drag after `THRESHOLD` pixels; before that a release is a click.
    """

    def __init__(self, session: EditingSession) -> None:
        self._session = session
        self._press: _Press | None = None

    @property
    def is_pressed(self) -> bool:
        """Whether a gesture is in flight."""
        return self._press is not None

    @property
    def scrolls(self) -> bool:
        """Whether a gesture is in flight that moves the view on at the edge."""
        press = self._press
        return press is not None and (press.drag is None or press.drag.scrolls)

    def press(
        self,
        pointer: Pointer,
        drag: Drag | None,
        on_click: Callable[[], None] | None = None,
        *,
        active: int | None = None,
        chooses: frozenset[int] = frozenset(),
    ) -> None:
        """Begin: past the threshold `drag`, if any, takes over; a release before that is `on_click`.

        `active` is the curve to edit once it has taken over, where it makes another one; the curves that it
        `chooses` are chosen with it, and no longer where it is taken back.
        """
        self._press = _Press(pointer.pixel, drag, on_click, moving=False, active=active, chooses=chooses)

    def press_at_once(
        self,
        pointer: Pointer,
        drag: Drag,
        on_done: Callable[[], None] | None = None,
        *,
        makes: int | None = None,
        active: int | None = None,
    ) -> None:
        """Begin a drag that shows its effect at the press (a new point) and commits without any move.

        `on_done` is called after the commit; `active` is the curve to edit from the press on, where the drag
        makes another one. The point that it `makes` is selected as soon as it is there.
        """
        self._press = _Press(
            pointer.pixel, drag, None, moving=True, on_done=on_done, active=active, makes=makes
        )
        self._step(pointer)

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        press = self._press
        if press is None:
            return
        if not press.moving:
            press.moving = math.dist(pointer.pixel, press.pixel) >= THRESHOLD
        if press.moving and press.drag is not None:
            self._step(pointer)

    def _step(self, pointer: Pointer) -> None:
        press = self._press
        assert press is not None
        assert press.drag is not None
        try:
            document = press.drag.document_at(pointer)
        except EditError as reason:
            press.refused = str(reason)
            self._session.refuse(press.refused)
            return
        press.last, press.refused, press.followed = document, "", pointer
        if self._session.preview(document, active=press.active) and press.makes is not None:
            self._session.selected.set_points([press.makes])
            press.makes = None
        if press.chooses and not press.shows_choice and self._session.is_previewing:
            # Not before: what was chosen comes back with the document that a preview replaces.
            press.shows_choice = True
            self._session.selected.show_choice(press.chooses)

    def nudge(self, drag: Drag, run: Hashable) -> None:
        """Do a drag at once, with the pointer at the origin; quick nudges of the same run are one step."""
        is_done = self._session.change(drag.name, lambda _document: drag.document_at(ORIGIN), run=run)
        if is_done and (text := drag.readout(ORIGIN)):
            self._session.say(" · ".join(filter(None, (text, drag.remark))))

    def exchange(self, pointer: Pointer, drag: Drag) -> None:
        """Go on with another drag from the same press: an axis was locked, an amount typed."""
        if self._press is not None:
            self._press.drag, self._press.moving = drag, True
            self._step(pointer)

    def progress_at(self, pointer: Pointer) -> str:
        """Return the amount of the drag in flight and what modifiers would change, or why it is refused."""
        press = self._press
        if press is None or press.drag is None or not press.moving:
            return ""
        if press.refused or not (text := press.drag.readout(pointer)):
            return press.refused
        return " · ".join(
            part for part in (text, press.drag.remark, press.drag.keys, "Escape cancels") if part
        )

    def place_at(self, pointer: Pointer) -> Vector | None:
        """Return where the point is that the drag in flight holds, None where it holds none."""
        press = self._press
        if press is None or press.drag is None or not press.moving or press.refused:
            return None
        return press.drag.place_at(pointer)

    def about_at(self, pointer: Pointer) -> Vector | None:
        """Return what the drag in flight rotates or skews about, None where it does neither."""
        press = self._press
        return press.drag.about(pointer) if press is not None and press.drag is not None else None

    def release(self, pointer: Pointer) -> None:
        """End: commit what the drag made, or click; a drag that is refused is taken back."""
        if self._press is not None and self._press.drag is not None and self._press.drag.refusal:
            refusal = self._press.drag.refusal
            self.cancel()
            self._session.refuse(refusal)
            return
        if self._press is not None and self._press.followed != pointer:
            self.move(pointer)
        press, self._press = self._press, None
        if press is None:
            return
        if press.moving and press.drag is not None and press.last is not None:
            # The step ends with what it has chosen, so that redo knows of it.
            active = min(
                press.chooses, key=lambda at: abs(at - self._session.active_index), default=press.active
            )
            is_done = self._session.commit(press.last, press.drag.name_at(pointer), active=active)
            if is_done and press.on_done is not None:
                press.on_done()
            if is_done and press.chooses:
                self._session.selected.choose(press.chooses)
            if is_done and press.drag.remark:
                self._session.say(f"{press.drag.remark}.")
        elif not press.moving and press.on_click is not None:
            press.on_click()

    def cancel(self) -> bool:
        """Drop the gesture in flight and everything it showed; return whether there was one."""
        press = self._press
        self.reset()
        if press is None:
            return False
        self._session.cancel()
        if press.moving and press.drag is not None:
            self._session.say(CANCELLED)
        return True

    def reset(self) -> None:
        """Drop the gesture in flight without touching the document: somebody else has replaced it."""
        self._press = None
