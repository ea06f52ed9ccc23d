"""What is validated beside the window is not validated again, and nothing else is let through."""

import pytest

from app.document.model import Document, make_curve
from app.storage.format_error import FormatError
from app.storage.validation import prevalidate, validate_changes


def test_a_prevalidated_step_is_validated_once_and_no_other_is_accepted():
    before = Document((make_curve([(0, 0), (1, 1)]),))
    fit = Document((*before.curves, make_curve([(0, 0), (2, 1)])))
    unfit = Document((*before.curves, make_curve([(0, 0), (1e300, 1)])))
    prevalidate(before, unfit)
    with pytest.raises(FormatError):
        validate_changes(before, unfit)
    prevalidate(before, fit)
    with pytest.raises(FormatError):
        validate_changes(before, unfit)
    with pytest.raises(FormatError):
        validate_changes(fit, unfit)
    validate_changes(before, fit)
