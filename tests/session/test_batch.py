"""What several signals tell together is shown once, at the end of it."""

from app.session.session import Batch


def test_a_batch_calls_a_function_once_at_its_end():
    batch, shown = Batch(), []

    def show():
        shown.append(bool(batch))

    batch.then(show)
    assert shown == [False], "at once, where nothing is being told"
    with batch:
        batch.then(show)
        with batch:
            batch.then(show)
        assert len(shown) == 1, "what is within another is not the end"
    assert shown == [False, False]


def test_a_function_of_a_batch_may_begin_another_batch():
    batch, shown = Batch(), []

    def show_points():
        shown.append("points")

    def show_document():
        shown.append("document")
        with batch:
            batch.then(show_points)

    with batch:
        batch.then(show_document)
    assert shown == ["document", "points"]


def test_a_batch_calls_its_functions_after_a_failure():
    batch, shown = Batch(), []
    try:
        with batch:
            batch.then(lambda: shown.append("as it is"))
            raise LookupError
    except LookupError:
        pass
    assert shown == ["as it is"]
    assert not batch
