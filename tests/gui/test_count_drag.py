"""A drag of a point goes through so much of the program, and no more."""

from tests.count_drag import second_drag, total


def test_a_drag_calls_few_functions(new_editor):
    functions, files, calls = total(second_drag(new_editor))
    assert functions <= 880
    assert files <= 135
    assert calls <= 5700
