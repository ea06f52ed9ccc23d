"""The highlight that Copy, Cut, Duplicate and Delete act on, and its removal."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from PySide6.QtWidgets import QApplication

from ..document.several_curves import active_after_removal
from ..session import Change, Session
from ..session.highlight import Highlight
from .context import WindowContext


@runtime_checkable
class ListsCurves(Protocol):
    """A list that tells which curves its keys are about."""

    meant: frozenset[int]


def highlighted(context: WindowContext) -> Highlight:
    """Return the highlight: with the focus in the list of curves, the curves of its highlighted rows."""
    focus = QApplication.focusWidget()
    in_list = focus is not None and context.docks["curvesDock"].isAncestorOf(focus)
    if in_list and isinstance(focus, ListsCurves):
        return Highlight(focus.meant)
    return context.session.selected.highlight(whole_curves=in_list)


def highlighted_curves(context: WindowContext) -> frozenset[int]:
    """Return what commands on curves are about: rows of the list that has the focus, or whole shapes."""
    focus = QApplication.focusWidget()
    return focus.meant if isinstance(focus, ListsCurves) else context.session.selected.whole


def remove(session: Session, what: Highlight, verb: str) -> Change:
    """Remove what was highlighted as one step, such as "Delete 3 points"."""
    document, active = session.document, session.active_index
    gone = what.curves_of(document)
    change = session.change(
        f"{verb} {what.words(document)}",
        what.removed_from,
        active=active_after_removal(document, gone, active) if gone else None,
    )
    if change:
        session.selected.set_points([])
    return change
