"""Curves that are not edited: a press edits one, Shift+click chooses it too, a drag moves the chosen ones."""

from __future__ import annotations

from app.document.several_curves import named
from app.tools.machine import DragMachine, Host
from app.tools.pointer import Hint, Hit, Part, Pointer
from app.tools.subject import Subject


class Choosing:
    """What presses on curves mean that are not edited.

    Attributes
    ----------
    entered
        What is said after a click with the press by which a curve came to be edited; empty for other presses.
    """

    def __init__(self, host: Host, machine: DragMachine, subject: Subject) -> None:
        self._host, self._machine, self._subject = host, machine, subject
        self.entered = ""

    def enter(self, pointer: Pointer) -> bool:
        """Edit the curve under a press from now on, so that the press acts on it; return whether it does.

        With Shift, and on a curve that is chosen together with others, a press means all of them.
        """
        hit, host = pointer.hit, self._host
        if (
            hit is None
            or hit.part is not Part.OTHER_CURVE
            or pointer.shift
            or hit.index in host.chosen_curves
        ):
            return False
        host.activate(hit.index)
        self.entered = self._edited()
        host.say(self.entered)
        return True

    def press(self, pointer: Pointer, hit: Hit) -> None:
        """Begin a click on the curve hit, or where it is chosen a drag of all that are."""
        drag = self._subject.moving_curves(pointer) if hit.index in self._host.chosen_curves else None
        click = self._toggle if pointer.shift else self._edit
        self._machine.press(pointer, drag, on_click=lambda: click(hit.index))

    def _edit(self, curve: int) -> None:
        self._host.activate(curve)
        self._host.say(self._edited())

    def _edited(self) -> str:
        return f"Editing “{self._host.active_view.source.name}” now."

    def _toggle(self, curve: int) -> None:
        host = self._host
        host.choose_curves(host.chosen_curves ^ {curve})
        host.say(f"{what_is_chosen(host)}.")

    def choose_none(self) -> bool:
        """Choose the active curve alone; return whether there were others."""
        host = self._host
        had_others = len(host.chosen_curves) > 1
        if had_others:
            host.choose_curves((host.active_index,))
            host.say(f"Only “{host.active_view.source.name}” is chosen.")
        return had_others

    def hint(self, hit: Hit) -> Hint:
        """Return what a press on another curve would do."""
        host = self._host
        name, chosen = host.document.curves[hit.index].name, host.chosen_curves
        if hit.index not in chosen:
            is_locked = host.document.curves[hit.index].locked
            drag = " (locked)" if is_locked else ", drag to bend it or move a point"
            return Hint(f"Click to edit “{name}”{drag} · Shift+click: choose it too", grab=True)
        if refusal := self._subject.refusal_of_curves:
            return Hint(refusal)
        moving = named(host.document, chosen)
        keys = "Shift: one axis, a click takes it out"
        return Hint(f"Drag to move {moving} · {keys} · Click to edit “{name}” alone", grab=True)

    def idle_hint(self) -> Hint | None:
        """Return the hint beside everything while the transforms act on several curves."""
        group = self._subject.group
        if group is None or not group.is_several:
            return None
        what = what_is_chosen(self._host)
        return Hint(f"{what} · G moves, S scales, R turns them · Click here: only the one edited")


def what_is_chosen(host: Host) -> str:
    """Tell which curves the tools act on."""
    what, active = named(host.document, host.chosen_curves), host.active_view.source.name
    if len(host.chosen_curves) == 1:
        return f"Only “{active}” is chosen"
    return f"{what} chosen, “{active}” is edited"
