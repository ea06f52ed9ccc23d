"""Claims of the lesson, and what its steps ask for."""

from itertools import pairwise


def claims(lesson):
    nine, hermite = lesson.curve(), lesson.curve(family="hermite")
    by_segment = [lesson.lebesgue(nine, *ends) for ends in pairwise(lesson.parameters(nine))]
    yield "its half-width is ε · Λ(t)", 0.5
    yield "between the first two points and between the last two", 2, 2
    yield "It is widest between the first", sorted(by_segment)[-2:] == sorted([by_segment[0], by_segment[7]])
    yield "Λ(t) reaches 11", lesson.lebesgue(nine)
    yield "falls below 3", 3
    yield "Press 2 for", lesson.key("familyHermite")
    yield "a share of 0.14", lesson.share_felt(hermite, 4, 5)
    yield "error in point 4", lesson.point(nine, 4)
    yield "0.04 two segments further on", lesson.share_felt(hermite, 4, 6), 2
    yield "from 11 to 1.5", lesson.lebesgue(nine), lesson.lebesgue_with_estimates(hermite)


def reach_goal_4(editor):
    """Change the parameters."""
    editor.choose_parametrization("chebyshev")


def reach_goal_5(editor):
    """Press 2 for **Hermite**."""
    editor.press_key("2")
