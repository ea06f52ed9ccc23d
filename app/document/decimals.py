"""Numbers added and multiplied as the decimals that they are written as."""

from __future__ import annotations

from decimal import Decimal


def decimal_sum(a: float, b: float) -> float:
    """Return a + b as the decimal numbers that they are written as."""
    return float(Decimal(repr(a)) + Decimal(repr(b)))


def decimal_product(a: float, b: float) -> float:
    """Return a · b as the decimal numbers that they are written as."""
    return float(Decimal(repr(a)) * Decimal(repr(b)))
