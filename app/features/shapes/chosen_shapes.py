"""The shapes that an action means."""

from __future__ import annotations

from ...session import Session


def meant(session: Session) -> frozenset[int]:
    """Return the chosen curves, or the one that is edited, with all others of their shapes."""
    return session.selected.highlight(whole_curves=True).curves
