"""What several signals tell together is shown once, at the end of it."""

from app.session.signals import Telling


def test_it_is_shown_once_when_all_is_told():
    telling, shown = Telling(), []

    def show():
        shown.append(bool(telling))

    telling.then(show)
    assert shown == [False], "at once, where nothing is being told"
    with telling:
        telling.then(show)
        with telling:
            telling.then(show)
        assert len(shown) == 1, "what is within another is not the end"
    assert shown == [False, False]


def test_what_is_shown_may_tell_of_more():
    telling, shown = Telling(), []

    def show_points():
        shown.append("points")

    def show_document():
        shown.append("document")
        with telling:
            telling.then(show_points)

    with telling:
        telling.then(show_document)
    assert shown == ["document", "points"]


def test_after_a_failure_it_is_shown_too():
    telling, shown = Telling(), []
    try:
        with telling:
            telling.then(lambda: shown.append("as it is"))
            raise LookupError
    except LookupError:
        pass
    assert shown == ["as it is"]
    assert not telling
