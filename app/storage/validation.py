"""Requirements of a document that go beyond types: of the whole, of each field, and of the settings."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cache
from itertools import chain, repeat
from operator import attrgetter, is_

from msgspec.structs import replace

from ..document.constraints import has_parallel_velocities
from ..document.derivatives import VECTORS
from ..document.differences import known_curves, moved_points
from ..document.fields import Field, Value, fields_of
from ..document.groups import shape_problem
from ..document.limits import MAX_MAGNITUDE, are_within
from ..document.model import Curve, Document, ParametrizationKind, Point
from ..families import Family, may_be_name
from .format_error import RANGE, FormatError, quoted, shortened


def validate(document: Document) -> None:
    """Raise FormatError, with the place, unless `document` may be saved.

    A document has at least one curve, and its fields hold what `fields` says of them. Every number is finite,
    its magnitude at most `MAX_MAGNITUDE`. A parametrization has start < end. The parameters that the points
    carry increase strictly in the order of the points, also where a rule is in force and they are only
    remembered; under the manual parametrization every point carries one. Tied velocities are both there, and
    parallel. A curve may have one point or none. The curves of a shape follow each other and look the same.
    """
    if not document.curves:
        raise FormatError("curves must hold at least one curve")
    validate_changes(None, document)
    if problem := shape_problem(document):
        raise FormatError(problem)


_foreseen: tuple[Document, Document] | None = None
"""What was found to be fit beside the window: documents before and after the step that is to come."""


def prevalidate(before: Document, after: Document) -> None:
    """Validate beside the window what is to become of a document; `validate_changes` then need not."""
    global _foreseen  # noqa: PLW0603
    # What is wrong is told by whoever makes the step.
    with suppress(FormatError):
        validate_changes(before, after)
        _foreseen = (before, after)


def _is_foreseen(before: Document | None, after: Document) -> bool:
    """Whether a step was found to be fit before; that is forgotten then, for it is asked once."""
    global _foreseen  # noqa: PLW0603
    if _foreseen is None or _foreseen[0] is not before or _foreseen[1] is not after:
        return False
    _foreseen = None
    return True


def validate_changes(before: Document | None, after: Document) -> None:
    """Raise FormatError, as `validate` does, for what in `after` is not the same object as in `before`."""
    if _is_foreseen(before, after):
        return
    if (
        before is not None
        and (moved := moved_points(before, after)) is not None
        and _are_positions_within(moved)
    ):
        return
    known, by_points = known_curves(before)
    same_places = before is not None and len(before.curves) == len(after.curves)
    old = before.curves if before is not None and same_places else repeat(None, len(after.curves))
    for index, (curve, was) in enumerate(zip(after.curves, old, strict=True)):
        if id(curve) not in known:
            _validate_curve(curve, f"curves[{index}]", by_points.get(id(curve.points), was))
    check_fields(after, before=before)


def _validate_curve(curve: Curve, place: str, before: Curve | None) -> None:
    """Raise FormatError for what is not the same object as in the curve that was there `before`."""
    check_fields(curve, place, before)
    if before is not None and all(map(is_, _what_runs(curve), _what_runs(before))):
        return
    rule = curve.parametrization
    if not rule.start < rule.end:
        raise FormatError(
            f"{place}.parametrization.end must be greater than {rule.start!r}, the start, not {rule.end!r}"
        )
    _validate_ties(curve, place)
    if not _all_within(curve.points):
        for index, point in enumerate(curve.points):
            check_fields(point, f"{place}.points[{index}]")
    _validate_parameters(curve, place)


_what_runs = attrgetter("points", "parametrization", "closed")


def _validate_ties(curve: Curve, place: str) -> None:
    """Raise FormatError unless tied velocities are both there, in one direction; those of even points are."""
    if not any(map(any, map(attrgetter("tied", "even"), curve.points))):
        return
    for index, point in enumerate(curve.points):
        if point.tied and not (type(point.tied) is bool and has_parallel_velocities(point)):
            raise FormatError(
                f"{place}.points[{index}].tied needs a corner, velocity and velocity_after in one direction"
            )
        if point.even and not (type(point.even) is bool and point.tied):
            raise FormatError(f"{place}.points[{index}].even needs a point that is tied")


def _validate_parameters(curve: Curve, place: str) -> None:
    """Raise FormatError unless the parameters that the points carry increase strictly."""
    # No list of pairs: of a million points it would take half of what these take themselves.
    times = [point.t for point in curve.points]
    if curve.is_manual and None in times:
        raise FormatError(
            f"{place}.points[{times.index(None)}].t is missing; "
            f'under "{ParametrizationKind.MANUAL}" every point carries its parameter'
        )
    before, low = -1, None
    for index, high in enumerate(times):
        if high is None:
            continue
        if low is not None and not low < high:
            whose = "the point before it" if before == index - 1 else f"points[{before}]"
            raise FormatError(
                f"{place}.points[{index}].t must be greater than {low!r}, the t of {whose}, not {high!r}"
            )
        before, low = index, high
    if curve.closed and curve.is_manual and low is not None and not low < curve.parametrization.end:
        raise FormatError(
            f"{place}.parametrization.end must be greater than {low!r}, the t of the last point: "
            "there the closed curve returns to its first point"
        )


def _all_within(points: tuple[Point, ...]) -> bool:
    """Whether all numbers of points are floats that may be saved, at one look: one by one takes too long.

    Where it is not so, somebody must look which is not.
    """
    return all(map(are_within, _columns(points)))


def _are_positions_within(points: Sequence[Point]) -> bool:
    """Whether points may be at their places."""
    return all(map(are_within, _places(points)))


def _places(points: Sequence[Point]) -> Iterator[list[float]]:
    yield list(map(attrgetter("x"), points))
    yield list(map(attrgetter("y"), points))


def _columns(points: Sequence[Point]) -> Iterator[list[float]]:
    yield from _places(points)
    yield [t for t in map(attrgetter("t"), points) if t is not None]
    for _, name in VECTORS:
        # A vector of two numbers is true, whatever they are.
        yield list(chain.from_iterable(filter(None, map(attrgetter(name), points))))


# Fields: the annotations of `document.fields` say what each may hold


def check_fields(values: Value, place: str = "", before: Value | None = None) -> None:
    """Raise FormatError, with the place, unless a document may hold what a value holds.

    Curves and points are looked at elsewhere, and nothing that is the same object as in `before`.
    """
    for field in _checked_fields(type(values)):
        content = getattr(values, field.name)
        # Most hold what they do from the start: of thousands of curves all styles are looked at.
        if content is field.default or (content is None and field.is_optional):
            continue
        if content is getattr(before, field.name, field):
            continue
        where = f"{place}.{field.name}" if place else field.name
        if not field.is_many:
            _check_item(field, content, where)
            continue
        for index, each in enumerate(content):
            _check_item(field, each, f"{where}[{index}]")
        _require(field, content, where, of_all=True)


def check_number(value: object, place: str) -> None:
    """Raise FormatError, with the place, unless a document may hold a number."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise FormatError(f"{place} must be a number, not {value!r}")
    # Written so that NaN fails.
    if not -MAX_MAGNITUDE <= value <= MAX_MAGNITUDE:
        raise FormatError(f"{place} {RANGE}, not {_short_number(value)}")


@cache
def _checked_fields(kind: type[Value]) -> tuple[Field, ...]:
    found = (field for field in fields_of(kind) if field.kind not in (Curve, Point))
    return tuple(
        field for field in found if field.requirements or field.kind in (float, str) or field.holds_values
    )


def _check_item(field: Field, value: object, place: str) -> None:
    if isinstance(value, Value):
        check_fields(value, place)
        return
    if field.kind is float:
        check_number(value, place)
    _require(field, value, place, of_all=False)
    if isinstance(value, str) and not _is_utf8(value):
        raise FormatError(f"{place} holds a character that UTF-8 cannot carry")


def _require(field: Field, value: object, place: str, *, of_all: bool) -> None:
    for each in field.requirements:
        if each.of_all == of_all and not each.is_met(value):
            shown = each.displayed(value)
            text = quoted(shown) if isinstance(shown, str) else shortened(repr(shown))
            raise FormatError(f"{place} must {each.text}, not {text}")


def _is_utf8(text: str) -> bool:
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def _short_number(value: object) -> str:
    """Return a number that may be an int of a million digits."""
    return repr(value) if isinstance(value, float) else "a larger one"


# Settings of families


def settings_problem(curve: Curve) -> str:
    """Return what is wrong with the settings of a curve, with their place; empty where nothing is."""
    if problem := _settings_problem(curve.family, curve.settings):
        return f"settings{problem}"
    seen = {curve.family}
    for index, (family, settings) in enumerate(curve.other_settings):
        place = f"other_settings[{index}]"
        if family in seen:
            return f"{place} must be of a family that has none before it, not {family}"
        seen.add(family)
        if problem := _settings_problem(family, settings):
            return f"{place}[1]{problem}"
    return ""


def without_default_settings(curve: Curve) -> Curve:
    """Return the curve with those settings alone that are not their families' defaults."""
    others = (
        (family, family.settings.without_defaults(settings)) for family, settings in curve.other_settings
    )
    return replace(
        curve,
        settings=curve.family.settings.without_defaults(curve.settings),
        other_settings=tuple(each for each in others if each[1]),
    )


def _settings_problem(family: Family, settings: Mapping[str, object]) -> str:
    """Return what is wrong with settings, to follow their place in the file; empty where nothing is.

    Of a family that is missing nobody knows which it has: names and values that one might are kept.
    """
    for name, value in settings.items():
        if setting := family.settings.named(name):
            is_allowed, requirement = setting.allows(value), setting.requirement
        elif family.is_missing and may_be_name(name):
            is_allowed, requirement = _may_be_setting(value), "a number or a word"
        else:
            return f" has a key that {family} does not know: {_shortened_json(name)}"
        if not is_allowed:
            return f".{name} must be {requirement}, not {_shortened_json(value)}"
    return ""


def _may_be_setting(value: object) -> bool:
    return may_be_name(value) or (type(value) in (int, float) and abs(value) <= MAX_MAGNITUDE)  # type: ignore[arg-type]


def _shortened_json(value: object) -> str:
    """Return a value of JSON as it stands in a file, where that is short."""
    if isinstance(value, list | dict):
        return "a list" if isinstance(value, list) else "an object {…}"
    if isinstance(value, int) and abs(value) > MAX_MAGNITUDE:
        return "a larger one"
    text = str(value)
    return json.dumps(f"{text[:40]}…" if isinstance(value, str) and len(text) > 40 else value)
