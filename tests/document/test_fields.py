"""Fields of the document's values: every one is made plain, held against its requirements, and has words."""

from __future__ import annotations

import re

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.fields import Value, fields_of
from app.document.model import Axis, Document, Guide, Point, ReferenceImage, make_curve
from app.document.plain_numbers import with_plain_numbers
from app.document.style import Style
from app.exchange.units import enlarged
from app.families import HERMITE
from app.storage.format_error import FormatError
from app.storage.validation import validate, validate_changes
from tests.rows import each_row

PAIR = (1.0, 2.0)


OPEN = replace(
    make_curve((), family=HERMITE),
    points=(
        Point(0.0, 0.0, 0.0, PAIR, PAIR, True, PAIR, PAIR, PAIR, PAIR),
        Point(1.0, 1.0, 1.0, PAIR, PAIR, True, PAIR, PAIR, PAIR, PAIR),
    ),
)


FULL_CURVE = replace(
    OPEN,
    style=Style(
        width=1.0,
        dash=(1.0, 2.0),
    ),
    groups=("Group 1",),
)

FULL = Document(
    (FULL_CURVE,),
    image=ReferenceImage("/a.png", 0.0, 0.0, 1.0, 1.0),
    guides=(Guide(Axis.X, 1.0),),
)
"""A number wherever a document may have one."""


def parts(values, steps=()):
    """Yield the fields of a value and of the values in it: the way there, the field, and what is there."""
    for field in fields_of(type(values)):
        held = getattr(values, field.name)
        for index, each in enumerate(held) if field.is_many else [(None, held)]:
            way = (*steps, (field.name, index))
            yield way, field, each
            if isinstance(each, Value):
                yield from parts(each, way)


def name_of(way):
    return ".".join(name if index is None else f"{name}[{index}]" for name, index in way)


def with_other(values, way, other):
    """Return a value with another number at the end of a way."""
    (name, index), *rest = way
    held = getattr(values, name)
    old = held if index is None else held[index]
    new = with_other(old, rest, other) if rest else other
    return replace(values, **{name: new if index is None else (*held[:index], new, *held[index + 1 :])})


def value_at(values, way):
    for name, index in way:
        values = getattr(values, name) if index is None else getattr(values, name)[index]
    return values


NUMBERS = [way for way, field, _ in parts(FULL) if field.kind is float]


def test_the_document_above_has_a_number_wherever_one_may_be():
    for way, field, held in parts(FULL):
        assert field.kind is not float or type(held) is float, name_of(way)
        assert not field.holds_values or isinstance(held, Value), name_of(way)
    empty = [
        (type(each).__name__, field.name)
        for each in (FULL, *(held for _, _, held in parts(FULL) if isinstance(held, Value)))
        for field in fields_of(type(each))
        if (field.kind is float or field.holds_values) and getattr(each, field.name) in ((), None)
    ]
    assert empty == []
    validate(FULL)


@each_row("way", NUMBERS, ids=name_of)
def test_a_number_of_numpy_becomes_one_of_python(way):
    given = with_other(FULL, way, np.float64(value_at(FULL, way)))
    assert type(value_at(given, way)) is np.float64
    assert type(value_at(with_plain_numbers(given, FULL), way)) is float
    assert with_plain_numbers(given) == FULL


@each_row("way", NUMBERS, ids=name_of)
def test_a_value_that_is_no_number_is_refused_with_its_field(way):
    """Also at the door, which looks at what is new alone."""
    given = with_other(FULL, way, float("nan"))
    for check in (validate, lambda document: validate_changes(FULL, document)):
        with pytest.raises(FormatError) as refusal:
            check(given)
        assert str(refusal.value).startswith(f"{name_of(way)} must lie between")


def test_every_length_scales_with_the_unit():
    """What is added to the document is a length, which another unit scales, or stands here."""
    twice = enlarged(FULL, 2.0)
    stays = {
        re.sub(r"\[\d+\]", "", name_of(way))
        for way in NUMBERS
        if value_at(FULL, way) and value_at(twice, way) != 2.0 * value_at(FULL, way)
    }
    of_styles = {"miter_limit", "dash", "stroke_opacity", "fill_opacity"}
    of_curves = {"points.t", "parametrization.alpha", "parametrization.end"}
    of_curves |= {f"style.{name}" for name in of_styles}
    assert stays == {f"curves.{name}" for name in of_curves} | {"image.opacity"}


def test_every_field_of_a_style_has_a_label():
    """The history names a step by them."""
    assert [field.name for field in fields_of(Style) if field.label == field.name] == []
