"""Older versions of the file format, turned into the present one step by step.

Whoever raises the version adds here how a file of the version before becomes one of the next; nothing else
has to know about old files. Fields that version 3 does not have are dropped, and counted: see `DROPPED`.

To drop a field of the document, a curve, a style or a guide: remove it there, and add a row to `DROPPED`.
To drop whole curves by what their form was: add that kind of form, and a noun for it, to `DROPPED_FORMS`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from enum import Enum, auto
from functools import partial
from typing import Any, Final

import msgspec

from ..document.words import enumerated

Values = dict[str, Any]
"""The plain values of an object in a file."""

Migration = Callable[[Values], Values]
"""Turns the plain values of a file of one version into those of the next."""


class LeftOut(msgspec.Struct, frozen=True):
    """What a file of an older version held and a document does not: how many of each kind.

    Attributes
    ----------
    counts
        How many there were, by the noun for one.
    words
        The same as "2 texts" and the like.
    """

    counts: Mapping[str, int] = {}
    words: tuple[str, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.words)

    @property
    def is_one(self) -> bool:
        """Whether it is a single thing."""
        return sum(self.counts.values()) == 1

    def sentence(self, name: str) -> str:
        """Return what to say of a file of this name that holds more than the document."""
        return self.said_of(f"“{name}”")

    def said_of(self, subject: str) -> str:
        """Return the same of anything that holds more."""
        verb = "was" if self.is_one else "were"
        return f"{subject} was made with a version that had more: {enumerated(self.words)} {verb} left out."


NOTHING: Final = LeftOut()


class Place(Enum):
    """The objects of a file from which fields are dropped."""

    DOCUMENT = auto()
    CURVE = auto()
    STYLE = auto()
    GUIDE = auto()


def _is_there(value: object) -> bool:
    return bool(value)


class Dropped(msgspec.Struct, frozen=True):
    """A field that older versions had.

    Attributes
    ----------
    place, field
        The object that has it, and its name.
    noun, plural
        What one and several are called where they are counted, by default the noun with an s; an empty noun
        where dropping it is no loss. A list is counted as its items.
    is_loss
        Whether a value, or an item, counts; by default all that are not empty, zero or false. Several rows
        may count what one field holds by different nouns.
    concerns
        Whether an object that has the field counts; by default all do.
    is_shared
        Whether equal values count once, such as one of a group that each of its curves holds.
    mend
        Changes the object in place of the field, given its value.
    """

    place: Place
    field: str
    noun: str = ""
    plural: str = ""
    is_loss: Callable[[Any], bool] = _is_there
    concerns: Callable[[Values], bool] = _is_there
    is_shared: bool = False
    mend: Callable[[Values, Any], object] | None = None


def _is_set(word: object) -> bool:
    return word != "none"


def _fade(style: Values, share: object) -> None:
    """Multiply the opacities of stroke and fill; what is no number is left for the decoder to refuse."""
    for name in ("stroke_opacity", "fill_opacity"):
        opacity = style.get(name, 1.0)
        is_known = isinstance(share, (int, float)) and isinstance(opacity, (int, float))
        style[name] = round(share * opacity, 6) if is_known else share


def _fade_with_groups(curve: Values, looks: object) -> None:
    style = curve.setdefault("style", {})
    for look in _dicts(looks):
        if isinstance(style, dict):
            _fade(style, look.get("opacity", 1.0))


def _paints_twice(style: Values) -> bool:
    """Whether a style has both a stroke and a fill."""
    return bool(style.get("stroke", "") != "none" and style.get("fill", "none") != "none")


def _is_clear(look: object) -> bool:
    return isinstance(look, dict) and look.get("opacity", 1.0) != 1.0


def _begins_text(line: object) -> bool:
    return not (isinstance(line, dict) and line.get("follows"))


def _is_pattern(paint: object) -> bool:
    return isinstance(paint, dict) and paint.get("tile") is not None


def _is_gradient(paint: object) -> bool:
    return isinstance(paint, dict) and paint.get("tile") is None


def _with_opacity(field: str, style: Values, gradient: object) -> None:
    """Let the colour that stands for a gradient be seen as much as its stops are."""
    if not isinstance(gradient, dict) or _is_pattern(gradient):
        return
    stops = _dicts(gradient.get("stops"))
    opacities = [each.get("opacity", 1.0) for each in stops]
    if opacities and all(isinstance(each, int | float) for each in [*opacities, style.get(field, 1.0)]):
        style[field] = style.get(field, 1.0) * sum(opacities) / len(opacities)


def _dropped_paint(paint: str) -> list[Dropped]:
    """Return the rows of a gradient or a pattern that was there besides its mean colour."""
    field, mend = f"{paint}_gradient", partial(_with_opacity, f"{paint}_opacity")
    return [
        Dropped(Place.STYLE, field, "gradient", is_loss=_is_gradient, mend=mend),
        Dropped(Place.STYLE, field, "pattern", is_loss=_is_pattern),
    ]


DROPPED: list[Dropped] = [
    Dropped(Place.DOCUMENT, "layers"),
    Dropped(Place.DOCUMENT, "empty_layers", "empty layer"),
    *(Dropped(Place.GUIDE, field) for field in ("lean", "across", "locked")),
    # A rectangle, an ellipse or a star is what its points say.
    Dropped(Place.CURVE, "form"),
    Dropped(Place.DOCUMENT, "kept_texts", "text", is_loss=_begins_text),
    Dropped(Place.DOCUMENT, "kept_pictures", "picture", is_loss=lambda _picture: True),
    Dropped(Place.CURVE, "clone", "clone link"),
    Dropped(Place.CURVE, "identity"),
    # The letters of such a text are shapes, and stay.
    Dropped(Place.CURVE, "text"),
    Dropped(Place.STYLE, "start_marker", "arrowhead", is_loss=_is_set),
    Dropped(Place.STYLE, "end_marker", "arrowhead", is_loss=_is_set),
    Dropped(
        Place.STYLE,
        "paint_order",
        "order of fill and line",
        "orders of fill and line",
        lambda order: order == "stroke",
    ),
    *_dropped_paint("fill"),
    *_dropped_paint("stroke"),
    Dropped(Place.STYLE, "blur", "blur"),
    Dropped(Place.STYLE, "masks", "mask", is_shared=True),
    Dropped(Place.STYLE, "clips", "clip", is_loss=lambda _clip: True, is_shared=True),
    Dropped(
        Place.STYLE,
        "opacity",
        "opacity of fill and stroke together",
        "opacities of fill and stroke together",
        is_loss=lambda share: share != 1.0,
        concerns=_paints_twice,
        mend=_fade,
    ),
    Dropped(
        Place.CURVE,
        "group_looks",
        "opacity of a group",
        "opacities of groups",
        is_loss=_is_clear,
        is_shared=True,
        mend=_fade_with_groups,
    ),
    Dropped(Place.DOCUMENT, "page", "page"),
    Dropped(Place.DOCUMENT, "y_up"),
]
"""The fields of version 2 that version 3 does not have."""

DROPPED_FORMS: dict[str, str] = {"lettering": "text", "picture": "picture"}
"""Nouns of the curves of version 2 that go whole, by the kind of their form."""

_NEW_CURVE: Final[Values] = {
    "name": "Curve 1",
    "family": "lagrange",
    "parametrization": {"kind": "chord_length"},
    "points": [],
}


def _with_styles(values: Values) -> Values:
    """Return a file of version 1 as one of version 2: the colour of a curve is that of its stroke."""
    return {**values, "curves": [_with_style(curve) for curve in values["curves"]]}


def _with_style(curve: Values) -> Values:
    rest = {key: value for key, value in curve.items() if key != "colour"}
    return {**rest, "style": {"stroke": curve["colour"]}} if "colour" in curve else rest


MIGRATIONS: dict[int, Migration] = {1: _with_styles, 2: lambda values: values}
"""By the version that a migration starts from; what `DROPPED` names is left out after all of them."""


def can_migrate(version: int, to: int) -> bool:
    """Whether there is a way from `version` to the version `to`."""
    return version < to and all(step in MIGRATIONS for step in range(version, to))


class Migrated(msgspec.Struct, frozen=True):
    """The values of a file in the present version, and what they had more before."""

    values: Values
    left_out: LeftOut


def migrated(values: Values, version: int, to: int) -> Migrated:
    """Return the values of a file of `version` as they stand in a file of the version `to`."""
    for step in range(version, to):
        values = {**MIGRATIONS[step](values), "version": step + 1}
    return _reduced(values)


def _reduced(values: Values) -> Migrated:
    """Return values without what is dropped; those that are none of a file stay for the decoder to refuse."""
    counts = Counter[str]()
    if isinstance(values.get("curves"), list):
        values = {**values, "curves": _curves_that_stay(values["curves"], counts)}
    if isinstance(values.get("guides"), list):
        values = {**values, "guides": _guides_that_stay(values["guides"], counts)}
    fields: dict[tuple[Place, str], list[Dropped]] = {}
    for row in DROPPED:
        fields.setdefault((row.place, row.field), []).append(row)
    for (place, field), rows in fields.items():
        holders = [each for each in _objects(values, place) if field in each]
        for row in rows:
            if row.noun:
                counts[row.noun] += _count(row, [each[field] for each in holders if row.concerns(each)])
        for holder in holders:
            value = holder.pop(field)
            for mend in (row.mend for row in rows if row.mend is not None):
                mend(holder, value)
    plurals = {row.noun: row.plural for row in DROPPED if row.plural}
    found = {noun: count for noun, count in counts.items() if count}
    words = tuple(
        f"{count} {noun if count == 1 else plurals.get(noun, noun + 's')}" for noun, count in found.items()
    )
    return Migrated(values, LeftOut(found, words))


def _curves_that_stay(curves: list[Any], counts: Counter[str]) -> list[Any]:
    stay = []
    for curve in curves:
        form = curve.get("form") if isinstance(curve, dict) else None
        noun = DROPPED_FORMS.get(str(form.get("kind"))) if isinstance(form, dict) else None
        if noun is None:
            stay.append(curve)
        else:
            counts[noun] += 1
    return stay if stay or not curves else [_NEW_CURVE]


def _guides_that_stay(guides: list[Any], counts: Counter[str]) -> list[Any]:
    """Return the guides that are level or upright."""
    stay = [each for each in guides if not isinstance(each, dict) or not each.get("lean")]
    counts["leaning guide"] += len(guides) - len(stay)
    return stay


def _objects(values: Values, place: Place) -> Iterator[Values]:
    if place is Place.DOCUMENT:
        yield values
        return
    for each in _dicts(values.get("guides" if place is Place.GUIDE else "curves")):
        if place is not Place.STYLE:
            yield each
        elif isinstance(each.get("style"), dict):
            yield each["style"]


def _dicts(values: object) -> Iterator[Values]:
    if isinstance(values, list):
        yield from (each for each in values if isinstance(each, dict))


def _count(row: Dropped, values: list[Any]) -> int:
    items = [item for value in values for item in (value if isinstance(value, list) else [value])]
    lost = [item for item in items if row.is_loss(item)]
    return len({msgspec.json.encode(item) for item in lost}) if row.is_shared else len(lost)
