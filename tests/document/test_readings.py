"""Coordinates as they are told: exact decimals, there and back, and nothing of it where there is no page."""

from __future__ import annotations

import re
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Document, Page, make_curve
from app.document.readings import PLAIN, readings_of

A4 = Document((make_curve([(20.0, 276.9)]),), page=Page(0.0, 0.0, 210.0, 297.0), unit="mm")


def numbers(count=300):
    """Return numbers of up to nine decimals, as people type them."""
    random = np.random.default_rng(5)
    digits = random.integers(0, 9, count, endpoint=True)
    values = random.uniform(-500, 500, count)
    return [round(float(value), int(most)) for value, most in zip(values, digits, strict=True)]


def test_297_less_276_9_is_20_1():
    """In binary it is 20.100000000000023."""
    told = readings_of(A4)
    assert (told.shown((20.0, 276.9)), told.meant((20.0, 20.1))) == ((20.0, 20.1), (20.0, 276.9))


@pytest.mark.parametrize("page", [Page(0, 0, 210, 297), Page(-7.25, 3.125, 100, 55.55), Page(0, -80, 60, 80)])
@pytest.mark.parametrize("up", [False, True])
def test_decimals_come_out_as_decimals_and_go_back(page, up):
    told = readings_of(replace(A4, page=page, y_up=up))
    x0, y0, height = (Decimal(repr(float(each))) for each in (page.x, page.y, page.height))
    for value in numbers():
        plain = Decimal(repr(value))
        down = plain - y0 if up else y0 + height - plain
        assert told.shown((value, value)) == (float(plain - x0), float(down))
        assert told.meant(told.shown((value, value))) == (value, value)
    many = np.array(numbers())
    for axis in (0, 1):
        assert told.all_shown_at(axis, many).tolist() == [told.shown_at(axis, each) for each in numbers()]
        assert told.all_meant_at(axis, told.all_shown_at(axis, many)).tolist() == numbers()


def test_without_a_page_and_from_the_origin_no_digit_changes():
    wild = np.array([1 / 3, -1e-200, 1e12, 5e-324, np.pi])
    sketch, opened = (readings_of(replace(A4, page=page)) for page in (None, Page(0, -80, 60, 80)))
    assert sketch == PLAIN
    assert readings_of(replace(A4, page=None, y_up=True)) == PLAIN
    assert sketch.all_shown_at(1, wild).tolist() == wild.tolist()
    # That of an opened SVG hangs at the origin: its numbers are those of the file.
    assert opened.all_shown_at(1, wild).tolist() == (-wild).tolist()
    assert opened.all_meant_at(1, -wild).tolist() == wild.tolist()


def test_a_number_that_is_none_stays_none():
    assert np.isnan(readings_of(A4).all_shown_at(1, np.array([np.nan, 1.0]))).tolist() == [True, False]


def test_words_of_places_and_angles_come_from_readings_alone():
    """Who writes two coordinates or an angle of the plane at once asks its readings: see CONTRIBUTING."""
    app = Path(__file__).parents[2] / "app"
    plain = re.compile(r"words\.(pair|angle)\(|from .*words import .*\b(pair|angle)\b")
    found = {
        str(path.relative_to(app)) for path in app.rglob("*.py") if plain.search(path.read_text("utf-8"))
    }
    assert found == {"document/readings.py"}
