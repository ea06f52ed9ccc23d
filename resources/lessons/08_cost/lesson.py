"""Claims of the lesson, and what its steps ask for."""

import numpy as np

from curvecore import operation_counts


def claims(lesson):
    twenty, forty = lesson.curve("Twenty points"), lesson.curve("Forty points")
    yield "Two ways", 2
    yield "the coefficients of 1, t, t²", 1
    yield "⅔ n³ operations", lesson.leading_coefficient("monomial", "setup", 3)
    yield "about 2n² operations for its denominators", lesson.leading_coefficient("lagrange", "setup", 2)
    yield "twenty points, that is", len(twenty.points)
    yield "7126 operations", operation_counts("monomial", 20).total(1)
    yield "against 1578", operation_counts("lagrange", 20).total(1)
    yield "computed with four digits", lesson.setting(1, "digits")
    yield "Lesson 4 is about them", lesson.number_of_lesson("decimal_accuracy")
    yield "Twice as many points", len(forty.points) / len(twenty.points)
    yield "Twice the points", len(forty.points) / len(twenty.points)
    yield "7.0 times the operations", lesson.growth_of_cost("monomial")
    yield "4.0 times", lesson.growth_of_cost("lagrange")
    yield "eight and four", 2**3, 2**2
    slopes = [round(np.log2(lesson.growth_of_cost(method, 10**6)), 5) for method in ("monomial", "lagrange")]
    yield "slopes 3 and 2", *slopes
    yield "a thousand points", 1000
    yield "about 4n operations", lesson.leading_coefficient("monomial", "per_point", 1)
    yield "formula 7n", lesson.leading_coefficient("barycentric", "per_point", 1)
    yield "the Lagrange functions 2n²", lesson.leading_coefficient("lagrange", "per_point", 2)


def do_step_3(editor):
    """Drag a point."""
    x, y = editor.point(20)
    editor.drag_point(20, to=(x, y + 0.3))
