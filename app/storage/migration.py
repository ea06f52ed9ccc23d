"""Migration of older versions of the file format to the present one, step by step.

Each new version adds a function that turns a file of the last version into one of the new version; no other
module knows about old files. Fields that version 3 does not have are dropped and counted, see `DROPPED`.

To drop a field of the document, a curve, a style or a guide: remove it there, and add a row to `DROPPED`.
To drop whole curves by the kind of their form: add the kind, and a noun for it, to `DROPPED_FORMS`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from enum import Enum, auto
from functools import partial
from typing import Any, Final

import msgspec
from msgspec.structs import replace

from .. import view_model
from ..document.model import Document
from ..document.words import count_of, enumerated

Values = dict[str, Any]
"""Plain values of an object in a file."""

Migration = Callable[[Values], Values]
"""Function that turns the plain values of a file of one version into those of the next."""


class LeftOut(msgspec.Struct, frozen=True):
    """Features of an older file that were left out of the document, counted by kind.

    Attributes
    ----------
    counts
        Their numbers, by the noun for one.
    words
        The same in words: "2 texts".
    points_set
        The number of points whose estimates were set, because the rules of this version estimate others.
    """

    counts: Mapping[str, int] = {}
    words: tuple[str, ...] = ()
    points_set: int = 0

    def __bool__(self) -> bool:
        return bool(self.words or self.points_set)

    @property
    def is_one(self) -> bool:
        """Whether a single feature was left out."""
        return sum(self.counts.values()) == 1

    def sentence(self, name: str) -> str:
        """Return the message about a file of this name."""
        return self.message_about(f"“{name}”")

    def message_about(self, subject: str) -> str:
        """Return the message about any subject: "It was made with …"."""
        points, are_set = count_of(self.points_set, "point"), "was" if self.points_set == 1 else "were"
        kept = f"{points} {are_set} set to keep the shape." if self.points_set else ""
        if not self.words:
            return f"{subject} was made with an older version: {kept}"
        verb = "was" if self.is_one else "were"
        lost = f"{enumerated(self.words)} {verb} left out. {kept}".rstrip()
        return f"{subject} was made with a version that had more features: {lost}"


NOTHING: Final = LeftOut()


class Holder(Enum):
    """Kind of object in a file whose fields may be dropped."""

    DOCUMENT = auto()
    CURVE = auto()
    STYLE = auto()
    GUIDE = auto()


def _is_true(value: object) -> bool:
    return bool(value)


class Dropped(msgspec.Struct, frozen=True):
    """Dropped field of older versions.

    Attributes
    ----------
    holder, field
        The kind of object that has the field, and its name.
    noun, plural
        Noun for one value and for several, by default with an s; an empty noun where dropping the field is no
        loss. The items of a list are counted.
    is_loss
        Function that returns whether a value, or an item, counts; by default if it is true. Several rows may
        count the values of one field under different nouns.
    concerns
        Function that returns whether an object with the field counts; by default all do.
    is_shared
        Whether equal values count once, such as a value of a group that each of its curves holds.
    mend
        Function that changes the object instead, given the value of the field.
    """

    holder: Holder
    field: str
    noun: str = ""
    plural: str = ""
    is_loss: Callable[[Any], bool] = _is_true
    concerns: Callable[[Values], bool] = _is_true
    is_shared: bool = False
    mend: Callable[[Values, Any], object] | None = None


def _is_set(word: object) -> bool:
    return word != "none"


def _fade(style: Values, share: object) -> None:
    """Multiply the opacities of stroke and fill; other values are left for the decoder to refuse."""
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
    """Return whether a style has both a stroke and a fill."""
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
    """Give the colour that replaces a gradient the mean opacity of its stops."""
    if not isinstance(gradient, dict) or _is_pattern(gradient):
        return
    stops = _dicts(gradient.get("stops"))
    opacities = [stop.get("opacity", 1.0) for stop in stops]
    if opacities and all(isinstance(value, int | float) for value in [*opacities, style.get(field, 1.0)]):
        style[field] = style.get(field, 1.0) * sum(opacities) / len(opacities)


def _dropped_paint(paint: str) -> list[Dropped]:
    """Return the rows of a gradient or pattern; its mean colour stays."""
    field, mend = f"{paint}_gradient", partial(_with_opacity, f"{paint}_opacity")
    return [
        Dropped(Holder.STYLE, field, "gradient", is_loss=_is_gradient, mend=mend),
        Dropped(Holder.STYLE, field, "pattern", is_loss=_is_pattern),
    ]


DROPPED: list[Dropped] = [
    Dropped(Holder.DOCUMENT, "layers"),
    Dropped(Holder.DOCUMENT, "empty_layers", "empty layer"),
    *(Dropped(Holder.GUIDE, field) for field in ("lean", "across", "locked")),
    # Rectangles, ellipses and stars keep their points.
    Dropped(Holder.CURVE, "form"),
    Dropped(Holder.DOCUMENT, "kept_texts", "text", is_loss=_begins_text),
    Dropped(Holder.DOCUMENT, "kept_pictures", "picture", is_loss=lambda _picture: True),
    Dropped(Holder.CURVE, "clone", "clone link"),
    Dropped(Holder.CURVE, "identity"),
    # The letters of a text are shapes, and stay.
    Dropped(Holder.CURVE, "text"),
    Dropped(Holder.STYLE, "start_marker", "arrowhead", is_loss=_is_set),
    Dropped(Holder.STYLE, "end_marker", "arrowhead", is_loss=_is_set),
    Dropped(
        Holder.STYLE,
        "paint_order",
        "order of fill and line",
        "orders of fill and line",
        lambda order: order == "stroke",
    ),
    *_dropped_paint("fill"),
    *_dropped_paint("stroke"),
    Dropped(Holder.STYLE, "blur", "blur"),
    Dropped(Holder.STYLE, "masks", "mask", is_shared=True),
    Dropped(Holder.STYLE, "clips", "clip", is_loss=lambda _clip: True, is_shared=True),
    Dropped(
        Holder.STYLE,
        "opacity",
        "opacity of fill and stroke together",
        "opacities of fill and stroke together",
        is_loss=lambda share: share != 1.0,
        concerns=_paints_twice,
        mend=_fade,
    ),
    Dropped(
        Holder.CURVE,
        "group_looks",
        "opacity of a group",
        "opacities of groups",
        is_loss=_is_clear,
        is_shared=True,
        mend=_fade_with_groups,
    ),
    Dropped(Holder.DOCUMENT, "page", "page"),
    Dropped(Holder.DOCUMENT, "y_up"),
]
"""The fields of version 2 that version 3 does not have."""

DROPPED_FORMS: dict[str, str] = {"lettering": "text", "picture": "picture"}
"""Nouns of curves of version 2 that are dropped, by the kind of their form."""

_NEW_CURVE: Final[Values] = {
    "name": "Curve 1",
    "family": "lagrange",
    "parametrization": {"kind": "chord_length"},
    "points": [],
}


def _with_styles(values: Values) -> Values:
    """Return a file of version 1 as one of version 2: the colour of a curve becomes that of its stroke."""
    return {**values, "curves": [_with_style(curve) for curve in values["curves"]]}


def _with_style(curve: Values) -> Values:
    rest = {key: value for key, value in curve.items() if key != "colour"}
    return {**rest, "style": {"stroke": curve["colour"]}} if "colour" in curve else rest


MIGRATIONS: dict[int, Migration] = {1: _with_styles, 2: lambda values: values, 3: lambda values: values}
"""Migrations by the version that they start from; fields in `DROPPED` are left out after the last one."""

_ESTIMATES_FOLLOW = 4
"""The version from which on rules estimate derivatives from those that are set, besides the points."""


def with_shapes_kept(document: Document, version: int, left_out: LeftOut) -> tuple[Document, LeftOut]:
    """Return a document of an older version with those estimates set that its rules now change."""
    if version >= _ESTIMATES_FOLLOW:
        return document, left_out
    document, count = view_model.reshape.with_older_estimates(document)
    return document, replace(left_out, points_set=count)


def can_migrate(version: int, to: int) -> bool:
    """Return whether files of `version` can be migrated to the version `to`."""
    return version < to and all(step in MIGRATIONS for step in range(version, to))


class Migrated(msgspec.Struct, frozen=True):
    """Values of a file in the present version, and the features that were left out."""

    values: Values
    left_out: LeftOut


def migrated(values: Values, version: int, to: int) -> Migrated:
    """Return the values of a file of `version` as those of a file of the version `to`."""
    for step in range(version, to):
        values = {**MIGRATIONS[step](values), "version": step + 1}
    return _reduced(values)


def _reduced(values: Values) -> Migrated:
    """Return values without dropped fields and curves; invalid values are left for the decoder to refuse."""
    counts = Counter[str]()
    if isinstance(values.get("curves"), list):
        values = {**values, "curves": _remaining_curves(values["curves"], counts)}
    if isinstance(values.get("guides"), list):
        values = {**values, "guides": _remaining_guides(values["guides"], counts)}
    fields: dict[tuple[Holder, str], list[Dropped]] = {}
    for row in DROPPED:
        fields.setdefault((row.holder, row.field), []).append(row)
    for (kind, field), rows in fields.items():
        holders = [holder for holder in _objects(values, kind) if field in holder]
        for row in rows:
            if row.noun:
                counts[row.noun] += _count(row, [holder[field] for holder in holders if row.concerns(holder)])
        for holder in holders:
            value = holder.pop(field)
            for mend in (row.mend for row in rows if row.mend is not None):
                mend(holder, value)
    plurals = {row.noun: row.plural for row in DROPPED if row.plural}
    lost = {noun: count for noun, count in counts.items() if count}
    words = tuple(
        f"{count} {noun if count == 1 else plurals.get(noun, noun + 's')}" for noun, count in lost.items()
    )
    return Migrated(values, LeftOut(lost, words))


def _remaining_curves(curves: list[Any], counts: Counter[str]) -> list[Any]:
    remaining = []
    for curve in curves:
        form = curve.get("form") if isinstance(curve, dict) else None
        noun = DROPPED_FORMS.get(str(form.get("kind"))) if isinstance(form, dict) else None
        if noun is None:
            remaining.append(curve)
        else:
            counts[noun] += 1
    return remaining if remaining or not curves else [_NEW_CURVE]


def _remaining_guides(guides: list[Any], counts: Counter[str]) -> list[Any]:
    """Return the horizontal and vertical guides."""
    remaining = [guide for guide in guides if not isinstance(guide, dict) or not guide.get("lean")]
    counts["leaning guide"] += len(guides) - len(remaining)
    return remaining


def _objects(values: Values, kind: Holder) -> Iterator[Values]:
    if kind is Holder.DOCUMENT:
        yield values
        return
    for item in _dicts(values.get("guides" if kind is Holder.GUIDE else "curves")):
        if kind is not Holder.STYLE:
            yield item
        elif isinstance(item.get("style"), dict):
            yield item["style"]


def _dicts(values: object) -> Iterator[Values]:
    if isinstance(values, list):
        yield from (value for value in values if isinstance(value, dict))


def _count(row: Dropped, values: list[Any]) -> int:
    items = [item for value in values for item in (value if isinstance(value, list) else [value])]
    lost = [item for item in items if row.is_loss(item)]
    return len({msgspec.json.encode(item) for item in lost}) if row.is_shared else len(lost)
