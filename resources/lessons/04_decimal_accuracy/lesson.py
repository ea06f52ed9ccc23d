"""Claims of the lesson, and what its steps ask for."""

import numpy as np


def claims(lesson):
    methods = len(lesson.trial(16).outcomes)
    parameters = lesson.parameters(lesson.curve())
    condition = np.linalg.cond(np.vander(np.arange(8.0)))
    yield "in four ways with fewer", methods
    yield "four recipes", methods
    yield "these eight points", len(parameters)
    yield "again in four ways", methods
    yield "a polynomial in 1, t, t²", 1
    yield "With 16 digits", lesson.setting(1, "digits")
    yield "all four lie on the curve", methods
    yield "The coefficients of 1, t, t²", 1
    yield "Its columns 1, tᵢ", 1
    yield "is 5.3·10⁷", condition
    yield "lose 7.7 digits", np.log10(condition)
    yield (
        "with five digits, the curve loses 2.6",
        lesson.setting(3, "digits"),
        lesson.trial(5).outcome(lesson.monomial).lost,
    )
    yield "here 6.9: that is less than one digit", lesson.lebesgue(lesson.curve())
    yield "Eight digits", lesson.setting(4, "digits")
    yield (
        "for all four: the largest error is 0.00013",
        methods,
        max(outcome.worst[0] for outcome in lesson.trial(8).outcomes),
    )
    shift = lesson.usual_shift
    yield "**Shift t by 100**", shift
    yield "from 100 to 107", parameters[0] + shift, parameters[-1] + shift
    yield "κ has grown to 5.4·10²⁶", lesson.trial(8, shift).condition
    yield "Press 2 for", lesson.key("familyHermite")
    yield "more than four digits", lesson.setting(5, "digits")
    yield "the error is 0.003", lesson.largest_error(lesson.basis, 4, family="hermite")
    yield "counted from 0", parameters[0]
    yield "0.0007 in the first piece", lesson.error_in(0, lesson.monomial, 4, family="hermite")
    yield "0.14 in the last", lesson.error_in(6, lesson.monomial, 4, family="hermite")
    errors = [lesson.error_in(k, lesson.monomial, 4, family="hermite") for k in range(7)]
    yield "later pieces lose more", errors == sorted(errors)


def reach_goal_5(editor):
    """Press 2 for **Hermite**."""
    editor.press_key("2")
