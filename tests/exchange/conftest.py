"""Documents to export."""

import sys
from pathlib import Path

import msgspec
import numpy as np
import pytest

from app.document.model import Curve, Document, Parametrization, Point, make_curve
from app.document.style import Style
from app.families import FAMILIES, HERMITE, QUINTIC_HERMITE
from app.storage.files import load

EXAMPLES = sorted((Path(__file__).parents[2] / "resources" / "examples").glob("*.curve.json"))


@pytest.fixture
def forget(monkeypatch):
    """Have a module of a package imported anew when it is next asked for."""

    def forget(package, name):
        monkeypatch.delitem(sys.modules, f"{package.__name__}.{name}", raising=False)
        monkeypatch.delattr(package, name, raising=False)

    return forget


@pytest.fixture(params=EXAMPLES, ids=lambda path: path.name.partition(".")[0])
def example(request):
    """Each of the examples in turn."""
    return load(request.param)


@pytest.fixture(params=FAMILIES)
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


def _cornered(closed):
    """A cubic Hermite curve with a corner of two velocities, open or closed."""
    points = (
        Point(0.0, 0.0),
        Point(1.0, 2.0, velocity=(3.0, 1.0), corner=True, velocity_after=(1.0, -2.0)),
        Point(3.0, 1.5),
        Point(4.0, -1.0, corner=True),
        Point(2.0, -2.0),
    )
    rule = Parametrization(start=0.0, end=2.5)
    return Curve("Corner & co_1", HERMITE, rule, points, closed=closed)


def _random_points(name, count):
    """Points that depend on the name alone: one more family leaves those of the others where they are."""
    return np.random.default_rng([11, *name.encode()]).normal(size=(count, 2)).tolist()


def _kinds():
    for family in FAMILIES:
        points = _random_points(family.name, 6)
        yield family.name, make_curve(points, name=f"{family} 1", family=family)
    yield "lagrange of degree 24", make_curve(_circle(25), name="A spiral")
    yield "cornered", _cornered(closed=False)
    yield "cornered, closed", _cornered(closed=True)
    for family in (HERMITE, QUINTIC_HERMITE):
        ring = make_curve(_random_points(f"{family.name}, closed", 5), name="Ring", family=family)
        yield f"{family}, closed", msgspec.structs.replace(ring, closed=True, style=Style(stroke="#c04020"))


def _circle(count):
    angles = np.linspace(0.0, 5.0, count)
    return (np.exp(0.1 * angles)[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])).tolist()


KINDS = dict(_kinds())


@pytest.fixture(params=KINDS)
def kind(request):
    """A document of one curve: each family, of high degree, with corners, closed."""
    return Document((KINDS[request.param],))


@pytest.fixture
def gallery():
    """All of these in one document, and one that gives no curve yet."""
    return Document((*KINDS.values(), make_curve([(1.0, 1.0)], name="begun")))
