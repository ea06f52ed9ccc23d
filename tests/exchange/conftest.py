"""Documents to export."""

from pathlib import Path

import numpy as np
import pytest

from app.document.model import Document, Family, make_curve
from app.document.storage import load

EXAMPLES = sorted((Path(__file__).parents[2] / "resources" / "examples").glob("*.curve.json"))


@pytest.fixture(params=EXAMPLES, ids=lambda path: path.name.partition(".")[0])
def example(request):
    """Each of the examples in turn."""
    return load(request.param)


@pytest.fixture(params=list(Family))
def sketch(request):
    """Seven points in no order, in each family."""
    points = np.random.default_rng(7).normal(size=(7, 2)).tolist()
    return Document((make_curve(points, family=request.param),))


@pytest.fixture
def half_drawn():
    """A line, and a curve of a single point that gives no curve yet."""
    line = make_curve([(0.0, 0.0), (4.0, 1.0)], name="line")
    return Document((line, make_curve([(1.0, 1.0)], name="begun <&>")))


@pytest.fixture
def nothing():
    """Two points in one place under chord length."""
    return Document((make_curve([(1.0, 2.0), (1.0, 2.0)], name="dot"),))
