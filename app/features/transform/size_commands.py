"""The size of what was copied, given to what is chosen."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ... import exchange
from ...actions.declaration import Action, action_for_each
from ...actions.needs import CHOSEN, Need
from ...actions.sections import EDIT_SIZE
from ...document.model import Document
from ...document.several_curves import named, what_stays
from ...storage.format_error import FormatError
from ...view_model.boxes.bounds import Strokes
from ...view_model.boxes.resizing import Wanted, resized, resized_apart, size_of
from ...view_model.curve.curve_view import view_of
from ...view_model.shapes.formed import with_round_corners
from ...workbench.clipboard import clipboard_data, drawing_in, own_in
from ...workbench.context import WindowContext

if TYPE_CHECKING:
    from ...exchange.cubics_in import Imported

_NOTHING_TO_PASTE = "There is nothing on the clipboard that has a size; copy a curve, or SVG."


class _Paste(NamedTuple):
    """What of the copied size is given, and the words of the action.

    Attributes
    ----------
    what
        The size, or one of the sides.
    axes
        The sides: 0 for the width.
    apart
        Whether each chosen object gets it, and not all of them together.
    """

    what: str
    axes: tuple[int, ...]
    apart: bool

    @property
    def title(self) -> str:
        return f"Paste {self.what.capitalize()}{' Separately' if self.apart else ''}"

    @property
    def tip(self) -> str:
        proportions = "" if len(self.axes) > 1 else "; with Keep Proportions the other side follows"
        whom = "each chosen object" if self.apart else "what is selected or chosen, as a whole,"
        return (
            f"Give {whom} the {self.what} of what was copied, by the Transform panel's measure{proportions}"
        )


_PASTES = tuple(
    _Paste(what, axes, apart)
    for apart in (False, True)
    for what, axes in (("size", (0, 1)), ("width", (0,)), ("height", (1,)))
)

_SEVERAL = Need("two chosen curves or more (a group is one)", lambda now: now.object_count > 1)


class PasteSizeCommands:
    """Gives what is chosen the size of what was copied."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session, self._store = context, context.session, context.store
        self._tools = context.central.canvas.tools

    @action_for_each(
        _PASTES,
        lambda each: Action(
            f"paste{each.what.capitalize()}{'Separately' if each.apart else ''}",
            each.title,
            EDIT_SIZE,
            icon=f"paste-{each.what}",
            tip=each.tip,
            needs=_SEVERAL if each.apart else CHOSEN,
            keywords="same equal scale dimensions",
        ),
    )
    def _paste(self, each: _Paste) -> None:
        data = clipboard_data()
        try:
            copied = own_in(data)
        except FormatError:
            copied = None
        if copied is not None:
            self._give_size_of(each, copied)
        elif fragment := drawing_in(data):
            read = partial(exchange.svg.fragments.read_fragment, fragment)
            self._context.work.start(
                "Reading the size", read, partial(self._give_imported, each), Path("The size"), "pasted"
            )
        else:
            self._session.refuse(_NOTHING_TO_PASTE)

    def _give_imported(self, each: _Paste, drawing: Imported) -> None:
        self._give_size_of(each, drawing.document)

    def _give_size_of(self, each: _Paste, copied: Document) -> None:
        session, strokes = self._session, self._tools.settings.strokes
        sized = exchange.rescaled.in_unit(copied, session.document.unit)
        size = size_of([view_of(curve) for curve in sized.curves], strokes)
        if size is None or not any(size[axis] for axis in each.axes):
            session.refuse(_NOTHING_TO_PASTE)
            return
        # Nothing is squeezed to the size of a line along it.
        wanted = [size[axis] or None if axis in each.axes else None for axis in (0, 1)]
        self._give(each, (wanted[0], wanted[1]), strokes)

    def _give(self, each: _Paste, wanted: Wanted, strokes: Strokes) -> None:
        session, target = self._session, self._tools.target
        if refusal := target.refusal_of_keys:
            session.refuse(refusal)
            return
        group, about, chosen = target.for_keys, target.centre, session.selected.chosen
        is_even = self._store.state.keep_proportions
        stays = what_stays(session.document, chosen) if each.apart else group.stays

        def edit(document: Document) -> Document:
            if each.apart:
                new = resized_apart(
                    document, session.views, chosen, wanted, strokes, keeps_proportions=is_even
                )
            else:
                new = resized(
                    document, session.views, group, wanted, strokes, about, keeps_proportions=is_even
                )
            return with_round_corners(document, new, group, grow=strokes.rounded)

        subject = f"each of {named(session.document, chosen)}" if each.apart else target.words
        if session.change(f"Paste {each.what} to {subject}", edit) and stays:
            session.say(f"{stays}.")
