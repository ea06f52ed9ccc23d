"""The curves or points that Copy, Cut, Duplicate and Delete act on, and their removal."""

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
    """List of curves that keys act on while it has the focus."""

    target_curves: frozenset[int]


def is_in_list(context: WindowContext) -> bool:
    """Return whether the list of curves has the focus, so that keys act on whole curves."""
    focus = QApplication.focusWidget()
    return focus is not None and context.docks["curvesDock"].isAncestorOf(focus)


def highlighted(context: WindowContext) -> ClipboardSelection:
    """Return the selection for the clipboard: the curves of the focused list, or else that of the session."""
    focus, in_list = QApplication.focusWidget(), is_in_list(context)
    if in_list and isinstance(focus, ListsCurves):
        return ClipboardSelection(focus.target_curves)
    return context.session.selected.for_clipboard(whole_curves=in_list)


def highlighted_curves(context: WindowContext) -> frozenset[int]:
    """Return the curves that commands act on: those of the focused list, or else the selected ones."""
    focus, selected = QApplication.focusWidget(), context.session.selected
    if isinstance(focus, ListsCurves):
        return focus.target_curves
    return selected.for_clipboard(whole_curves=True).curves or selected.with_shapes


def remove(
    context: WindowContext, what: ClipboardSelection, verb: str, *, keeps_shape: bool = True
) -> Change:
    """Remove points or curves as one step, such as "Delete 3 points".

    The shape of curves without some of their points is kept as far as can be, or else the handles there.
    """
    session = context.session
    document, active, active_curves = session.document, session.active_index, session.selected.active_curves
    gone, deleted = what.curves_of(document), list[Deletion]()

    def without(document: Document, curve: int, indices: Collection[int]) -> Document:
        deleted.append(without_points(session.views[curve], indices))
        return document.with_curve(curve, deleted[-1].curve)

    def leaving(document: Document, curve: int, indices: Collection[int]) -> Document:
        return document.with_curve(curve, without_points_keeping_handles(session.views[curve], indices))

    delete = without if keeps_shape else leaving
    change = session.change(
        f"{verb} {what.label(document)}",
        lambda document: what.removed_from(document, delete),
        active=active_after_removal(document, gone, active, active_curves) if gone else None,
    )
    if change:
        session.selected.set_points([])
        session.report(_change_text(context, what, deleted), document.curves)
    return change


def _change_text(context: WindowContext, what: ClipboardSelection, deleted: Sequence[Deletion]) -> str:
    """Return the largest change of curves without some of their points; empty without any."""
    left = [deletion for deletion in deleted if deletion.residual is not None]
    if not left:
        return ""
    words, most = what.points.count_label, max(deletion.residual or 0.0 for deletion in left)
    if keeps_shape(most, [deletion.curve for deletion in left]):
        return f"Deleted {words}. The shape is unchanged."
    length = f"{number(most, 2)} {context.session.document.unit}".rstrip()
    text = f"Deleted {words}. The shape changed by up to {length}"
    if not any(deletion.is_fitted for deletion in deleted):
        return f"{text}."
    return f"{text}; {key_or_name(context.actions['deleteLeavingHandles'])} keeps the handles instead."
