"""The shapes that an action means."""

from __future__ import annotations

from typing import Final

from ...actions.needs import Need
from ...document.shapes import whole_shapes
from ...session import Session

AN_OBJECT: Final = Need("a curve", lambda state: state.has_selected_curve and not state.is_blank)

A_SHAPE: Final = Need("a shape", lambda state: state.has_selected_curve and not state.is_blank)


def meant(session: Session) -> frozenset[int]:
    """Return the chosen curves, or the one that is edited, with all others of their shapes."""
    return whole_shapes(session.document, session.selected.marked)
