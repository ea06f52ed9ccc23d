"""The project's targets with the figures of this run; printed as one table at the end."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One target."""

    what: str
    figure: float
    limit: float
    unit: str
    at_least: bool

    @property
    def holds(self) -> bool:
        return self.figure >= self.limit if self.at_least else self.figure <= self.limit

    def __str__(self) -> str:
        sign, verdict = "≥" if self.at_least else "≤", "holds" if self.holds else "MISSED"
        return f"{self.what:58s} {self.figure:9.2f} {sign} {self.limit:7.2f} {self.unit:5s} {verdict}"


rows: list[Row] = []


def at_most(what: str, figure: float, limit: float, unit: str = "ms") -> bool:
    """Note a figure that must not exceed its target; return whether it holds."""
    rows.append(Row(what, figure, limit, unit, at_least=False))
    return rows[-1].holds


def at_least(what: str, figure: float, limit: float, unit: str = "times") -> bool:
    """Note a figure that must reach its target; return whether it holds."""
    rows.append(Row(what, figure, limit, unit, at_least=True))
    return rows[-1].holds
