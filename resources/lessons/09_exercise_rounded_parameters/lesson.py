"""Claims of the lesson, and what its steps ask for."""


def claims(lesson):
    equal = lesson.curve("Equal steps")
    yield "Exercise: three decimals", 3
    yield "under two rules, with three decimals", len(lesson.document.curves), 3
    yield "Six points", len(equal.points)
    yield "equally spaced: 0, 0.2, 0.4, 0.6, 0.8, 1", *lesson.parameters(equal)
    yield "the five distances", len(equal.points) - 1
    yield "round to three decimals", 3
    yield "`4.1/9.7`", 4.1, 9.7
    yield "by at most 0.0005", 0.0005
    yield "with ε = 0 and δ = 0.0005", lesson.setting(4, "epsilon"), lesson.setting(4, "delta")


def reach_goal_2(editor):
    """Type the results into the column *t*."""
    editor.type_chord_lengths()
