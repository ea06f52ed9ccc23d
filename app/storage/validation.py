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
    """Raise FormatError, with the path of the field, unless a document may be saved.

    A document has at least one curve, and its fields meet their requirements. Every number is finite, its
    magnitude at most `MAX_MAGNITUDE`. A parametrization has start < end. The parameters that the points carry
    increase strictly, also where a rule gives the parameters and they are only stored; under the manual rule
    every point carries one. Tied velocities are explicit and parallel. A curve may have one point or none.
    The curves of a shape are neighbours in one style.
    """
    if not document.curves:
        raise FormatError("curves must hold at least one curve")
    validate_changes(None, document)
    if problem := shape_problem(document):
        raise FormatError(problem)


_prevalidated: tuple[Document, Document] | None = None
"""The documents before and after a coming step that was validated in the background."""


def prevalidate(before: Document, after: Document) -> None:
    """Validate a coming step in the background, so that `validate_changes` need not do it again."""
    global _prevalidated  # noqa: PLW0603
    # A problem is reported when the step is made.
    with suppress(FormatError):
        validate_changes(before, after)
        _prevalidated = (before, after)


def _is_prevalidated(before: Document | None, after: Document) -> bool:
    """Return whether a step was validated before; the record is dropped, because each step asks once."""
    global _prevalidated  # noqa: PLW0603
    if _prevalidated is None or _prevalidated[0] is not before or _prevalidated[1] is not after:
        return False
    _prevalidated = None
    return True


def validate_changes(before: Document | None, after: Document) -> None:
    """Raise FormatError, as `validate` does, for objects of `after` that are not in `before`."""
    if _is_prevalidated(before, after):
        return
    if before is not None and (moved := moved_points(before, after)) is not None and _are_valid(moved):
        return
    known, by_points = known_curves(before)
    same_count = before is not None and len(before.curves) == len(after.curves)
    old = before.curves if before is not None and same_count else repeat(None, len(after.curves))
    for index, (curve, was) in enumerate(zip(after.curves, old, strict=True)):
        if id(curve) not in known:
            _validate_curve(curve, f"curves[{index}]", by_points.get(id(curve.points), was))
    check_fields(after, before=before)


def _validate_curve(curve: Curve, path: str, before: Curve | None) -> None:
    """Raise FormatError for objects that are not in the curve `before`."""
    check_fields(curve, path, before)
    if before is not None and all(map(is_, _what_runs(curve), _what_runs(before))):
        return
    rule = curve.parametrization
    if not rule.start < rule.end:
        raise FormatError(
            f"{path}.parametrization.end must be greater than {rule.start!r}, the start, not {rule.end!r}"
        )
    _validate_ties(curve, path)
    if not _all_within(curve.points):
        for index, point in enumerate(curve.points):
            check_fields(point, f"{path}.points[{index}]")
    _validate_parameters(curve, path)


_what_runs = attrgetter("points", "parametrization", "closed")


def _validate_ties(curve: Curve, path: str) -> None:
    """Raise FormatError unless tied velocities are explicit and parallel, and even points tied."""
    if not any(map(any, map(attrgetter("tied", "even"), curve.points))):
        return
    for index, point in enumerate(curve.points):
        if point.tied and not (type(point.tied) is bool and has_parallel_velocities(point)):
            raise FormatError(
                f"{path}.points[{index}].tied needs a corner with parallel velocity and velocity_after"
            )
        if point.even and not (type(point.even) is bool and point.tied):
            raise FormatError(f"{path}.points[{index}].even needs a tied point")


def _validate_parameters(curve: Curve, path: str) -> None:
    """Raise FormatError unless the parameters that the points carry increase strictly."""
    # No list of pairs: for a million points it would take half the memory of the points.
    times = [point.t for point in curve.points]
    if curve.is_manual and None in times:
        raise FormatError(
            f"{path}.points[{times.index(None)}].t is missing; "
            f'under "{ParametrizationKind.MANUAL}" every point needs a parameter'
        )
    before, low = -1, None
    for index, high in enumerate(times):
        if high is None:
            continue
        if low is not None and not low < high:
            neighbour = "the point before it" if before == index - 1 else f"points[{before}]"
            raise FormatError(
                f"{path}.points[{index}].t must be greater than {low!r}, the t of {neighbour}, not {high!r}"
            )
        before, low = index, high
    if curve.closed and curve.is_manual and low is not None and not low < curve.parametrization.end:
        raise FormatError(
            f"{path}.parametrization.end must be greater than {low!r}, the t of the last point: "
            "there the closed curve returns to its first point"
        )


def _all_within(points: tuple[Point, ...]) -> bool:
    """Return whether all numbers of points are floats that may be saved; fast for many points."""
    return all(map(are_within, _columns(points)))


def _are_valid(points: Sequence[Point]) -> bool:
    """Return whether the positions of points may be saved."""
    return all(map(are_within, _position_columns(points)))


def _position_columns(points: Sequence[Point]) -> Iterator[list[float]]:
    yield list(map(attrgetter("x"), points))
    yield list(map(attrgetter("y"), points))


def _columns(points: Sequence[Point]) -> Iterator[list[float]]:
    yield from _position_columns(points)
    yield [t for t in map(attrgetter("t"), points) if t is not None]
    for _, name in VECTORS:
        # A vector is a tuple of two numbers, and therefore true.
        yield list(chain.from_iterable(filter(None, map(attrgetter(name), points))))


# Fields, by the requirements in their annotations


def check_fields(values: Value, path: str = "", before: Value | None = None) -> None:
    """Raise FormatError, with the path of the field, unless the fields of a value meet their requirements.

    Curves and points are checked elsewhere; objects of `before` are not checked again.
    """
    for field in _checked_fields(type(values)):
        content = getattr(values, field.name)
        # Most fields are at their defaults: the styles of thousands of curves are checked.
        if content is field.default or (content is None and field.is_optional):
            continue
        if content is getattr(before, field.name, field):
            continue
        where = f"{path}.{field.name}" if path else field.name
        if not field.is_many:
            _check_item(field, content, where)
            continue
        for index, item in enumerate(content):
            _check_item(field, item, f"{where}[{index}]")
        _require(field, content, where, of_all=True)


def check_number(value: object, path: str) -> None:
    """Raise FormatError, with the path of the field, unless a document may hold a number."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise FormatError(f"{path} must be a number, not {value!r}")
    # Written so that NaN fails.
    if not -MAX_MAGNITUDE <= value <= MAX_MAGNITUDE:
        raise FormatError(f"{path} {RANGE}, not {_short_number(value)}")


@cache
def _checked_fields(kind: type[Value]) -> tuple[Field, ...]:
    fields = (field for field in fields_of(kind) if field.kind not in (Curve, Point))
    return tuple(
        field for field in fields if field.requirements or field.kind in (float, str) or field.holds_values
    )


def _check_item(field: Field, value: object, path: str) -> None:
    if isinstance(value, Value):
        check_fields(value, path)
        return
    if field.kind is float:
        check_number(value, path)
    _require(field, value, path, of_all=False)
    if isinstance(value, str) and not _is_utf8(value):
        raise FormatError(f"{path} contains a character that UTF-8 cannot encode")


def _require(field: Field, value: object, path: str, *, of_all: bool) -> None:
    for requirement in field.requirements:
        if requirement.of_all == of_all and not requirement.is_met(value):
            part = requirement.displayed(value)
            text = quoted(part) if isinstance(part, str) else shortened(repr(part))
            raise FormatError(f"{path} must {requirement.text}, not {text}")


def _is_utf8(text: str) -> bool:
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def _short_number(value: object) -> str:
    """Return the text of a number, or "a larger one" for an integer, which may have a million digits."""
    return repr(value) if isinstance(value, float) else "a larger one"


# Settings of families


def settings_problem(curve: Curve) -> str:
    """Return the problem of the settings of a curve, with its field; empty for none."""
    if problem := _settings_problem(curve.family, curve.settings):
        return f"settings{problem}"
    families = {curve.family}
    for index, (family, settings) in enumerate(curve.other_settings):
        path = f"other_settings[{index}]"
        if family in families:
            return f"{path} must be of another family than those before it, not {family}"
        families.add(family)
        if problem := _settings_problem(family, settings):
            return f"{path}[1]{problem}"
    return ""


def without_default_settings(curve: Curve) -> Curve:
    """Return the curve without settings at their defaults."""
    others = (
        (family, family.settings.without_defaults(settings)) for family, settings in curve.other_settings
    )
    return replace(
        curve,
        settings=curve.family.settings.without_defaults(curve.settings),
        other_settings=tuple(entry for entry in others if entry[1]),
    )


def _settings_problem(family: Family, settings: Mapping[str, object]) -> str:
    """Return the problem of the settings of a family, to follow the name of the field; empty for none.

    The settings of a missing family are unknown: all possible names and values are accepted.
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
    """Return a value as JSON, shortened."""
    if isinstance(value, list | dict):
        return "a list" if isinstance(value, list) else "an object {…}"
    if isinstance(value, int) and abs(value) > MAX_MAGNITUDE:
        return "a larger one"
    text = str(value)
    return json.dumps(f"{text[:40]}…" if isinstance(value, str) and len(text) > 40 else value)
