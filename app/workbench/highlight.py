"""The highlight that Copy, Cut, Duplicate and Delete act on, and its removal."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Protocol, runtime_checkable

from PySide6.QtWidgets import QApplication

from ..actions.keymap import key_or_name
from ..document.model import Document
from ..document.several_curves import active_after_removal
from ..document.words import number
from ..session import Change
from ..session.selection import ClipboardSelection
from ..view_model.curve.distances import keeps_shape
from ..view_model.delete import Deletion, without_points, without_points_keeping_handles
from .context import WindowContext


@runtime_checkable
class ListsCurves(Protocol):
    """A list that tells which curves its keys are about."""

    meant: frozenset[int]


def is_in_list(context: WindowContext) -> bool:
    """Whether the list of curves has the focus: its keys are about whole curves."""
    focus = QApplication.focusWidget()
    return focus is not None and context.docks["curvesDock"].isAncestorOf(focus)


def highlighted(context: WindowContext) -> ClipboardSelection:
    """Return the highlight: with the focus in the list of curves, the curves of its highlighted rows."""
    focus, in_list = QApplication.focusWidget(), is_in_list(context)
    if in_list and isinstance(focus, ListsCurves):
        return ClipboardSelection(focus.meant)
    return context.session.selected.highlight(whole_curves=in_list)


def highlighted_curves(context: WindowContext) -> frozenset[int]:
    """Return what commands on curves are about: rows of the list that has the focus, or the highlight."""
    focus, selected = QApplication.focusWidget(), context.session.selected
    if isinstance(focus, ListsCurves):
        return focus.meant
    return selected.highlight(whole_curves=True).curves or selected.whole


def remove(
    context: WindowContext, what: ClipboardSelection, verb: str, *, keeps_shape: bool = True
) -> Change:
    """Remove what was highlighted as one step, such as "Delete 3 points".

    The shape of curves without some of their points is kept as far as can be, or else the handles there.
    """
    session = context.session
    document, active, edited = session.document, session.active_index, session.selected.edited
    gone, deleted = what.curves_of(document), list[Deletion]()

    def without(document: Document, curve: int, indices: Collection[int]) -> Document:
        deleted.append(without_points(session.views[curve], indices))
        return document.with_curve(curve, deleted[-1].curve)

    def leaving(document: Document, curve: int, indices: Collection[int]) -> Document:
        return document.with_curve(curve, without_points_keeping_handles(session.views[curve], indices))

    delete = without if keeps_shape else leaving
    change = session.change(
        f"{verb} {what.words(document)}",
        lambda document: what.removed_from(document, delete),
        active=active_after_removal(document, gone, active, edited) if gone else None,
    )
    if change:
        session.selected.set_points([])
        _say_change(context, what, deleted)
    return change


def _say_change(context: WindowContext, what: ClipboardSelection, deleted: Sequence[Deletion]) -> None:
    """Say by how much curves changed that were to keep their shape."""
    fitted = [each for each in deleted if each.residual is not None]
    if not fitted:
        return
    session = context.session
    words, most = what.points.count_label, max(each.residual or 0.0 for each in fitted)
    if keeps_shape(most, [each.curve for each in fitted]):
        session.say(f"Deleted {words}. The shape is unchanged.")
    else:
        length = f"{number(most, 2)} {session.document.unit}".rstrip()
        key = key_or_name(context.actions["deleteLeavingHandles"])
        session.say(f"Deleted {words}. The shape changed by up to {length}; {key} keeps the handles instead.")
