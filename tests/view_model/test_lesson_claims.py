"""Claims of lessons, computed anew: a number cannot be written without a check.

``claims(lesson)`` in the ``lesson.py`` of a lesson yields quotes of its text, each with the values of the
numbers in it, or with a truth where it has none. A number agrees with its value when that rounds to it.
"""

from __future__ import annotations

import pytest

from app.features.lessons.lesson import lesson_code, lesson_names, load_lesson
from app.storage.resources import resource
from app.view_model.basis import growth_of_points
from app.view_model.curve.curve_view import view_of
from tests.lesson_facts import LessonFacts, numbers_in, value_of
from tests.rows import each_row


def text_of(lesson):
    pages = [f"{lesson.title}\n{lesson.summary}", *(f"{step.title}\n{step.text}" for step in lesson.steps)]
    return "\n\n".join(pages)


def claims_of(name):
    """Return the quotes of a lesson and their values; without ``lesson.py`` there are none."""
    code = lesson_code(resource("lessons", name))
    return list(getattr(code, "claims", lambda _facts: ())(LessonFacts(load_lesson(name))))


@each_row("name", lesson_names())
def test_every_number_of_a_lesson_is_claimed_and_true(name):
    text, checked = text_of(load_lesson(name)), []
    for quote, *values in claims_of(name):
        assert text.count(quote) == 1, f"{quote!r} stands {text.count(quote)} times in the text"
        start = text.index(quote)
        inside = [each for each in numbers_in(text) if start <= each.start() < start + len(quote)]
        assert not inside or inside[-1].end() <= start + len(quote), f"{quote!r} cuts a number off"
        if not inside:
            assert [bool(value) for value in values] == [True], quote
            continue
        assert len(values) == len(inside), f"{quote!r} has the numbers {[each[0] for each in inside]}"
        for number, value in zip(inside, values, strict=True):
            stated, half_a_unit = value_of(number[0])
            assert value == pytest.approx(stated, abs=half_a_unit * 1.0001), f"{number[0]} in {quote!r}"
        checked += [each.start() for each in inside]
    missing = [each for each in numbers_in(text) if each.start() not in checked]
    around = [text[max(each.start() - 30, 0) : each.end() + 30] for each in missing]
    assert not missing, f"claims of {name} lack the numbers in {around}"


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ("from −6.5 to 6.1", [-6.5, 6.1]),
        ("κ is 5.3·10⁷, or 4·10⁻⁷", [5.3e7, 4e-7]),
        ("⅔ n³ and 2n² of one", [2 / 3, 2]),
        ("Eleven points, twice; nearly doubled", [11, 2, 2]),
    ],
)
def test_numbers_are_read_in_digits_and_in_words(text, numbers):
    assert [value_of(each[0])[0] for each in numbers_in(text)] == pytest.approx(numbers)


@pytest.mark.parametrize("rule", ["uniform", "centripetal", "chord_length"])
def test_the_lebesgue_constant_on_the_screen_includes_estimated_velocities(rule):
    """Λ was 1 on the screen, whatever the estimated velocities did: 1.50, 3.12 and 8.56 here."""
    facts = LessonFacts(load_lesson("03_chord_length"))
    curve = facts.curve(rule=rule, family="hermite")
    # The oracle has 4001 samples; at a maximum that is a relative error of about 1e-6.
    assert growth_of_points(view_of(curve)) == pytest.approx(facts.lebesgue_with_estimates(curve), rel=1e-4)
