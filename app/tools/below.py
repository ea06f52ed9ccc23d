"""Curves below the topmost: Alt+click means the next one below, and after the last one the topmost again."""

from __future__ import annotations

from typing import NamedTuple

from ..document.several_curves import named
from ..document.shape_edits import pressed
from ..document.shapes import shape_of
from .curve_picker import chosen_curves, edit_curve
from .tool import ToolContext


class Below(NamedTuple):
    """What Alt+click means: a curve, what is chosen with it, and which of how many it is there."""

    curve: int
    meant: frozenset[int]
    number: int
    among: int

    @property
    def words(self) -> str:
        """Which of how many it is, as a person counts from the top."""
        return f"{self.number} of {self.among} here"


def find_below(context: ToolContext) -> Below | None:
    """Return what Alt+click means at the pointer, None where it is a click like any."""
    pointer, host = context.pointer, context.host
    is_added = pointer.shift and not host.selected.is_editing
    if not pointer.alt or (pointer.shift and not is_added) or pointer.ctrl:
        return None
    places = context.surface.curves_at(pointer)
    # Several curves of one group are one thing to choose; to edit, each shape is one.
    is_editing, choice = host.selected.is_editing, host.selected.choice
    meant = {
        frozenset(shape_of(host.document, place))
        if is_editing
        else pressed(host.document, place, choice): place
        for place in reversed(places)
    }
    things = list(reversed(meant))
    if len(things) < 2:
        return None
    chosen = {host.active_index} if is_editing else host.selected.chosen
    now = max((at for at, thing in enumerate(things) if thing & chosen), default=0)
    after = (now + 1) % len(things)
    return Below(meant[things[after]], things[after], after + 1, len(things))


def click_below(context: ToolContext, below: Below) -> None:
    """Edit that curve; while none is edited, choose what it is in."""
    host = context.host
    if host.selected.is_editing:
        edit_curve(context, below.curve)
        said = f"Editing “{host.active_view.source.seen_name}” now"
    else:
        before = host.selected.chosen if context.pointer.shift else frozenset()
        host.selected.choose(before | below.meant)
        said = chosen_curves(host)
    host.say(f"{said} · {below.words} · Alt+click: the next below.")


def words_below(context: ToolContext, below: Below) -> str:
    """Return what a click would do."""
    host = context.host
    verb, places = ("edit", (below.curve,)) if host.selected.is_editing else ("choose", below.meant)
    return f"Click: {verb} “{named(host.document, places)}”, {below.words}"
