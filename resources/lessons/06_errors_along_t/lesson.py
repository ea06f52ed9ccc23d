"""Claims of the lesson, and what its steps ask for."""


def claims(lesson):
    nine, shift = lesson.curve(), lesson.usual_shift
    yield "computes with six digits", lesson.setting(1, "digits")
    flat = [lesson.error_in(k, lesson.monomial, 6) for k in range(8)]
    yield "the line of the monomials is flat", max(flat) < 10 * min(flat)
    yield "are rounded, to six digits", lesson.setting(2, "digits")
    yield "is 4·10⁻⁷ at t = 0.1", lesson.monomial_error_at(0.1, 6), 0.1
    end = lesson.parameters(nine)[-1]
    yield "and 0.03 at t = 8", lesson.monomial_error_at(end, 6), end
    rounded = {"rounding": lesson.coefficients}
    rising = [lesson.error_in(k, lesson.monomial, 6, **rounded) for k in range(8)]
    yield "The monomials get worse to the right", rising == sorted(rising)
    yield "**Shift t by 100**", shift
    shifted = [lesson.error_in(k, lesson.monomial, 6, shift=shift, **rounded) for k in range(8)]
    yield "the error is large at both ends", min(shifted) > max(rising)
    yield "the error is large at both ends", max(shifted) < 2 * min(shifted)
    yield "They have two digits", lesson.digits_of(lesson.points(nine))
    yield "rounding them to six", lesson.setting(2, "digits")
    errors = [lesson.error_in(k, lesson.lagrange, 6) for k in range(8)]
    yield "lower in the middle, higher at both ends", min(errors[0], errors[7]) > max(errors[2:6])
    yield "Press 2.", lesson.key("familyHermite")
    yield "at most 0.00004", lesson.largest_error(lesson.basis, 6, family="hermite")
    yield "never larger than 1.", lesson.highest(lesson.curve(family="hermite"))
    yield "0.001 in the last piece", lesson.error_in(7, lesson.monomial, 6, family="hermite")


def reach_goal_4(editor):
    """Press 2."""
    editor.press_key("2")
