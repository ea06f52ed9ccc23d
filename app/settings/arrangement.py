"""Arrangement of a window: what stands around the canvas in documents of one kind."""

from __future__ import annotations

import msgspec


class Arrangement(msgspec.Struct, frozen=True):
    """What stands around the canvas, where that differs with the kind of document.

    Attributes
    ----------
    basis
        Whether the basis functions are shown.
    numbered
        Whether points have numbers, and colours that say which is which.
    docks
        Names of the docks at the right that are brought up, in that order, so that the last of a place is in
        front; None where they are as in a new window.
    """

    basis: bool = True
    numbered: bool = True
    docks: tuple[str, ...] | None = None
