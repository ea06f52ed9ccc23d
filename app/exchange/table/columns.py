"""Columns of a table: their roles, by titles or by order, and the families that cells name."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, fields
from itertools import pairwise
from typing import NamedTuple

from ...document.derivatives import DERIVATIVES
from ...document.model import Curve
from ...families import FAMILIES, NO_SETTINGS, Family, FamilySettingValues, SettingValue
from ..errors import ExchangeError

ROLES = ("t", "x", "y", *(f"{derivative.letter}{axis}" for derivative in DERIVATIVES for axis in "xy"))
"""Roles of columns of numbers, for every point."""

AFTER = tuple(f"{role}_after" for role in ROLES[3:])
"""The derivatives after a corner; those of `ROLES` are the ones before it then."""

WORDS = ("curve", "family")
"""Roles of columns of text: the name of the row's curve, and its family."""

_UNITS = """m mm cm km dm µm um nm in inch ft px pt s ms µs us sec min h hz deg degree degrees rad °
m/s mm/s m/s² m/s^2 mps mps2 meter meters metre metres second pixel pixels - 1 none"""
UNITS = frozenset(_UNITS.split())
"""Words of a row of units, and behind titles."""

_FILL = "(?:pos|position|positions|coord|coords|coordinate|koordinate|wert|value|val|point|punkt|loc|location"
_FILL += "|data|axis|achse|dir)?"
_NAMES = {
    "t": "t|time|times|zeit|tau|param|parameter|sec|seconds|sekunden|timesec|elapsed|elapsedtime",
    "x": f"{_FILL}x{_FILL}|lon|long|longitude|lng|easting|east|laengengrad|längengrad|rechtswert|abscissa",
    "y": f"{_FILL}y{_FILL}|lat|latitude|northing|north|breitengrad|hochwert|ordinate",
    "vx": "vx|velx|xvel|velocityx|xvelocity",
    "vy": "vy|vely|yvel|velocityy|yvelocity",
    "ax": "ax|accx|xacc|accelerationx|xacceleration",
    "ay": "ay|accy|yacc|accelerationy|yacceleration",
    "jx": "jx|jerkx|xjerk",
    "jy": "jy|jerky|yjerk",
}
_PATTERNS = {role: re.compile(pattern) for role, pattern in _NAMES.items()}
_ALONG = re.compile("s|arclength|distance|station|chainage|bogenlaenge|bogenlänge")
_INDEX = re.compile(r"|index|unnamed: ?0|#|nr\.?|no\.?|row|id")


@dataclass(frozen=True)
class ColumnMapping:
    """The column of each role, counted from 0; None where there is none."""

    x: int
    y: int
    t: int | None = None
    vx: int | None = None
    vy: int | None = None
    ax: int | None = None
    ay: int | None = None
    jx: int | None = None
    jy: int | None = None
    vx_after: int | None = None
    vy_after: int | None = None
    ax_after: int | None = None
    ay_after: int | None = None
    jx_after: int | None = None
    jy_after: int | None = None
    curve: int | None = None
    family: int | None = None

    def columns(self, roles: Sequence[str]) -> dict[str, int]:
        """Return the columns that there are for some of the roles."""
        columns = {role: getattr(self, role) for role in roles}
        return {role: column for role, column in columns.items() if column is not None}


@dataclass(frozen=True)
class RoleGuess:
    """Roles that the columns of a table seem to have.

    Attributes
    ----------
    mapping
        Roles of the columns; None where no two columns are numbers.
    is_certain
        Whether the titles, or the lack of alternatives, decide it; otherwise the user is asked.
    """

    mapping: ColumnMapping | None
    is_certain: bool = True


def numbered_titles(count: int) -> tuple[str, ...]:
    """Return the titles of so many columns without titles."""
    return tuple(f"Column {number}" for number in range(1, count + 1))


def role_of(title: str) -> str:
    """Return the role of a column with this title; empty where the title has none.

    A unit in brackets, or behind the name, is ignored: "x [mm]", "time_s", "x in m".
    """
    plain = title.strip().lower()
    if plain in AFTER or plain in WORDS:
        return plain
    name = _without_unit(plain)
    return next((role for role, pattern in _PATTERNS.items() if pattern.fullmatch(name)), "")


def _without_unit(title: str) -> str:
    parts = [part for part in re.split(r"[\s_\-./:]+", re.split(r"[\[({]", title.lower())[0]) if part]
    while len(parts) > 1 and parts[-1] in UNITS:
        parts.pop()
    return "".join(parts)


def guess(
    titles: Sequence[str], rows: Sequence[Sequence[str]] = (), is_number: Sequence[bool] | None = None
) -> RoleGuess:
    """Return the roles of columns by their titles, or else by their order.

    Parameters
    ----------
    titles
        "Column 1" and so on, or empty, where there are none.
    rows
        The first rows: a column without a title that counts them is an index, and is left out.
    is_number
        For each column, whether it holds numbers; by default all do.
    """
    known = _named(titles)
    if {"x", "y"} <= set(known):
        # Not beside velocities, which are per unit of time.
        has_rates = not set(known) <= {"x", "y", *WORDS}
        along = [] if has_rates else _columns_along(titles, rows)
        return RoleGuess(ColumnMapping(**known | dict(zip(("t",), along, strict=False))))
    free = [
        column
        for column in range(len(titles))
        if (is_number is None or is_number[column]) and column not in known.values()
    ]
    has_titles = any(title != f"Column {number}" for number, title in enumerate(titles, start=1))
    # Without titles a first column that counts could be t.
    counted = [column for column in free if has_titles and _counts(titles[column], rows, column)]
    return _by_order(known, [column for column in free if column not in counted] or free)


def _by_order(known: dict[str, int], free: list[int]) -> RoleGuess:
    """Return the roles of columns by their order, where the titles do not name both x and y."""
    if "x" in known or "y" in known:
        missing = "y" if "x" in known else "x"
        mapping = ColumnMapping(**{**known, missing: free[0]}) if free else None
        return RoleGuess(mapping, is_certain=len(free) == 1)
    if "t" in known and len(free) == 1:
        # A function of time: its graph.
        rest = {role: column for role, column in known.items() if role != "t"}
        return RoleGuess(ColumnMapping(**{**rest, "x": known["t"], "y": free[0]}))
    if len(free) < 2:
        return RoleGuess(None)
    if len(free) == 3 and not known:
        return RoleGuess(ColumnMapping(free[1], free[2], t=free[0]), is_certain=False)
    return RoleGuess(
        ColumnMapping(**{**known, "x": free[0], "y": free[1]}), len(free) == 2 and "t" not in known
    )


def mapping_of(text: str, titles: Sequence[str]) -> ColumnMapping:
    """Return the roles of columns in a text: "t=time,x=pos_x,y=3", by title or number from 1.

    Raises
    ------
    ExchangeError
        For an unknown role or column, or without x or y.
    """
    roles = [field.name for field in fields(ColumnMapping)]
    columns: dict[str, int] = {}
    for item in text.split(","):
        role, _, column = (part.strip() for part in item.partition("="))
        if role not in roles:
            raise ExchangeError(f"“{role}” is not the role of a column; use {', '.join(roles)}.")
        columns[role] = _column(column, titles)
    if not {"x", "y"} <= set(columns):
        raise ExchangeError("A curve needs x and y: --columns x=…,y=…")
    return ColumnMapping(**columns)


def mapping_summary(mapping: ColumnMapping, titles: Sequence[str]) -> str:
    """Return a sentence on the roles of the columns, and on those left out.

    Empty where all titles are the names of their roles, unless y comes before x.
    """
    columns = mapping.columns((*ROLES, *AFTER, *WORDS))
    if columns == {title: index for index, title in enumerate(titles)} and columns["x"] < columns["y"]:
        return ""
    roles = ", ".join(f"{role} = {_quoted(titles, column)}" for role, column in columns.items())
    unused = [_quoted(titles, column) for column in range(len(titles)) if column not in columns.values()]
    return f"Columns: {roles}." + (f" Left out: {', '.join(unused)}." if unused else "")


def _quoted(titles: Sequence[str], column: int) -> str:
    title = titles[column]
    return title.lower() if title == f"Column {column + 1}" else f"“{title[:40]}”"


def _named(titles: Sequence[str]) -> dict[str, int]:
    """Return the columns whose titles have a role; of two alike, the one with the shorter title."""
    columns: dict[str, int] = {}
    for column, title in enumerate(titles):
        role = role_of(title)
        if role and (role not in columns or len(title) < len(titles[columns[role]])):
            columns[role] = column
    # Only with both coordinates of a vector: "vx" alone is the speed of a vehicle along its path.
    parts = (*ROLES[3:], *AFTER)
    halves = [pair for pair in zip(parts[::2], parts[1::2], strict=True) if not set(pair) <= set(columns)]
    return {role: column for role, column in columns.items() if not any(role in pair for pair in halves)}


def _columns_along(titles: Sequence[str], rows: Sequence[Sequence[str]]) -> list[int]:
    """Return the columns that are lengths along the curve by their titles, and increase in the first rows."""
    columns = [column for column, title in enumerate(titles) if _ALONG.fullmatch(_without_unit(title))]
    return [column for column in columns if _increases(rows, column)]


def _increases(rows: Sequence[Sequence[str]], column: int) -> bool:
    try:
        numbers = [float(row[column].replace(",", ".")) for row in rows]
    except (ValueError, IndexError):
        return False
    return len(numbers) > 1 and all(first < second for first, second in pairwise(numbers))


def _counts(title: str, rows: Sequence[Sequence[str]], column: int) -> bool:
    """Whether a column counts the rows, as the index that pandas writes, and no title claims otherwise."""
    is_untitled = bool(_INDEX.fullmatch(title.strip().lower())) or title == f"Column {column + 1}"
    cells = [row[column] if column < len(row) else "" for row in rows]
    counted = ([str(first + row) for row in range(len(cells))] for first in (0, 1))
    return column == 0 and is_untitled and len(cells) > 1 and cells in counted


def _column(text: str, titles: Sequence[str]) -> int:
    plain = [title.strip().lower() for title in titles]
    if text.lower() in plain:
        return plain.index(text.lower())
    if text.isdigit() and 1 <= int(text) <= len(titles):
        return int(text) - 1
    known = ", ".join(_quoted(titles, column) for column in range(min(len(titles), 12)))
    raise ExchangeError(f"There is no column “{text[:40]}”; the columns are {known}.")


# Families in cells


_CLOSED = "closed"


class FamilyCell(NamedTuple):
    """Content of a cell of families.

    Attributes
    ----------
    family, closed, settings
        As in the document; the last row of a closed curve is its first point again.
    """

    family: Family
    closed: bool = False
    settings: FamilySettingValues = NO_SETTINGS


def family_cell(curve: Curve) -> str:
    """Return the cell for a curve: closed hermite, or floater_hormann degree=5."""
    words = [_CLOSED] if curve.is_closed else []
    return " ".join(
        [*words, curve.family.name, *(f"{name}={value}" for name, value in curve.settings.items())]
    )


def read_family_cell(text: str) -> FamilyCell:
    """Return the family, the closing and the settings in a cell.

    Raises
    ------
    ValueError
        With the valid contents, as text that follows "must be".
    """
    words = text.strip().lower().split()
    closed = words[:1] == [_CLOSED]
    name, *pairs = words[closed:] or [""]
    family = FAMILIES.called(name)
    if family is None:
        raise ValueError(f"one of {', '.join(map(str, FAMILIES))}")
    settings = dict(_read_setting(family, pair) for pair in pairs)
    return FamilyCell(family, closed, family.settings.without_defaults(settings))


def _read_setting(family: Family, pair: str) -> tuple[str, SettingValue]:
    name, _, text = pair.partition("=")
    setting = family.settings.named(name)
    if setting is None:
        known = ", ".join(f"{family} {other.name}={other.default}" for other in family.settings.all)
        raise ValueError(known or f"{family} alone, which has no settings")
    value = setting.value_of(text)
    if not setting.allows(value):
        raise ValueError(f"{family} with {name}= and {setting.requirement}")
    return name, value
