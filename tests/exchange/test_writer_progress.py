"""Writers report their progress curve by curve, and stop on request."""

from __future__ import annotations

from itertools import pairwise

import pytest

from app.document.model import Document, make_curve
from app.exchange.files import export
from app.exchange.formats import FORMATS, endings_of
from app.exchange.options import Options
from app.families import FAMILIES
from app.tasks.progress import FINAL, Cancelled

COUNT = 12
# A document is what is there already: it is encoded in one go.
TOLD = [ending for ending in endings_of(FORMATS.written) if ending != ".curve.json"]


@pytest.fixture(scope="module")
def several():
    families = FAMILIES
    return Document(
        tuple(
            make_curve([(k, 0.0), (k + 0.5, 1.0), (k + 1.0, 0.3)], name=f"Curve {k}", family=families[k % 3])
            for k in range(COUNT)
        )
    )


@pytest.mark.parametrize("ending", TOLD)
def test_a_writer_reports_every_curve_and_can_be_cancelled_at_any(several, ending, tmp_path):
    """The loops had no report: Stop ended them by force, after a second."""
    shares = []
    path = tmp_path / f"curves{ending}"
    options = Options(
        width=200, format_options={"samples": 5}, report=lambda share, _word: shares.append(share)
    )
    export(several, path, options)
    assert shares.pop() == FINAL
    assert len(shares) >= 2 * COUNT  # computed, and written
    assert all(first <= second for first, second in pairwise(shares))
    assert 0.0 <= shares[0] <= shares[-1] <= 1.0
    # Nowhere between two reports more than the work of some curves.
    assert max(second - first for first, second in pairwise(shares)) < 0.5

    for last in (2, len(shares) // 2, len(shares) - 1):
        told = []

        def stop(share, _word, last=last, told=told):
            told.append(share)
            if len(told) > last:
                raise Cancelled

        path.unlink(missing_ok=True)
        with pytest.raises(Cancelled):
            export(several, path, options.reporting(stop))
        assert len(told) == last + 1
        assert not path.exists()
