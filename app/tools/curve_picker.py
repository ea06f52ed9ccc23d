"""Presses on curves that are not edited: to edit one, to select several, to move those."""

from __future__ import annotations

from ..document.several_curves import named
from .drag_machine import EditingHost
from .pointer import Hint, Hit, Part
from .tool import ToolContext


class CurvePicker:
    """Choice among curves: the one that is pressed is edited, and several are selected.

    Attributes
    ----------
    entered
        The sentence for a click with the press by which a curve came to be edited; empty for other presses.
    """

    def __init__(self) -> None:
        self.entered = ""

    def enter(self, context: ToolContext) -> ToolContext:
        """Edit the curve under a press, so that the press acts on it; return the context as it is then.

        With Shift, and on a curve that is selected together with others, a press means all of them.
        """
        self.entered = ""
        hit, host = context.hit, context.host
        if (
            hit is None
            or hit.part is not Part.OTHER_CURVE
            or context.pointer.shift
            or hit.index in host.selected.curves
        ):
            return context
        host.selected.activate(hit.index)
        self.entered = _edited(host)
        host.say(self.entered)
        return context.with_hit()

    def press(self, context: ToolContext, hit: Hit) -> None:
        """Begin a click on the curve hit, or where it is selected a drag of all that are."""
        host, target = context.host, context.target
        drag = target.moving_curves(context.pointer) if hit.index in host.selected.curves else None
        click = _toggle if context.pointer.shift else _edit
        context.drags.press(context.pointer, drag, on_click=lambda: click(host, hit.index))

    def unpick_others(self, context: ToolContext) -> bool:
        """Select the active curve alone; return whether there were others."""
        host = context.host
        had_others = len(host.selected.curves) > 1
        if had_others:
            host.selected.set_curves((host.active_index,))
            host.say(f"Only “{host.active_view.source.name}” is chosen.")
        return had_others

    def hint(self, context: ToolContext, hit: Hit) -> Hint:
        """Return what a press on another curve would do."""
        host = context.host
        name, selected = host.document.curves[hit.index].name, host.selected.curves
        if hit.index not in selected:
            is_locked = host.document.curves[hit.index].locked
            drag = " (locked)" if is_locked else ", drag to bend it or move a point"
            return Hint(f"Click to edit “{name}”{drag} · Shift+click: choose it too", grab=True)
        if refusal := context.target.refusal_of(context.target.curves):
            return Hint(refusal)
        moving = named(host.document, selected)
        keys = "Shift: one axis, a click takes it out"
        return Hint(f"Drag to move {moving} · {keys} · Click to edit “{name}” alone", grab=True)

    def idle_hint(self, context: ToolContext) -> Hint | None:
        """Return the hint beside everything while the transforms act on several curves."""
        group = context.target.group
        if group is None or not group.is_several:
            return None
        what = selected_curves(context.host)
        return Hint(f"{what} · G moves, S scales, R turns them · Click here: only the one edited")


def _edit(host: EditingHost, curve: int) -> None:
    host.selected.activate(curve)
    host.say(_edited(host))


def _edited(host: EditingHost) -> str:
    return f"Editing “{host.active_view.source.name}” now."


def _toggle(host: EditingHost, curve: int) -> None:
    host.selected.set_curves(host.selected.curves ^ {curve})
    host.say(f"{selected_curves(host)}.")


def selected_curves(host: EditingHost) -> str:
    """Return a sentence about the curves that the tools act on."""
    what, active = named(host.document, host.selected.curves), host.active_view.source.name
    if len(host.selected.curves) == 1:
        return f"Only “{active}” is chosen"
    return f"{what} chosen, “{active}” is edited"
