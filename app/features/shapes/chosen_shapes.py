"""The shapes that an action means."""

from __future__ import annotations

from typing import Final

from ...actions.needs import Need
from ...session import Session

A_SHAPE: Final = Need("a shape", lambda now: bool(meant(now.session)) and not now.is_blank)


def meant(session: Session) -> frozenset[int]:
    """Return the chosen curves, or the one that is edited, with all others of their shapes."""
    return session.selected.highlight(whole_curves=True).curves
