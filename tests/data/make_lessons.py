"""Makes the documents of resources/lessons: run `python tests/data/make_lessons.py` after a change here.

A test compares the files with what this makes, bit for bit.
"""

from pathlib import Path

from msgspec.structs import replace

from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point
from app.document.style import Style
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.storage.files import save

FOLDER = Path(__file__).parents[2] / "resources" / "lessons"
BLUE, ORANGE, VERMILLION = "#0072b2", "#e69f00", "#d55e00"
UNIFORM, CHORD, MANUAL = (
    ParametrizationKind.UNIFORM,
    ParametrizationKind.CHORD_LENGTH,
    ParametrizationKind.MANUAL,
)


def lessons():
    """Return the documents by the stem of their file."""
    return {
        "01_basis_functions": Document((five_points(), eleven_points())),
        "02_three_parameter_sets": Document(three_parameter_sets()),
        "03_chord_length": Document((uneven(),)),
        "04_decimal_accuracy": Document((eight_points(),)),
        "05_sensitivity": Document((nine_points(1.0),)),
        "06_errors_along_t": Document((nine_points(8.0),)),
        "07_cubic_or_quintic": Document(stations()),
        "08_cost": Document((wave("Twenty points", 20, 0.0), wave("Forty points", 40, 4.0))),
        "09_exercise_rounded_parameters": Document(exercise(SIX_POINTS)),
        "10_exercise_far_point": Document(exercise(FAR_POINT)),
        "11_runge": Document(bells()),
    }


def lagrange(name, points, kind=UNIFORM, end=1.0, **other):
    """A Lagrange curve through points under a rule, on the interval from 0 to `end`."""
    rule = Parametrization(kind, end=end)
    return Curve(name, LAGRANGE, rule, tuple(Point(x, y) for x, y in points), **other)


def timed(name, points, parameters, **other):
    """A Lagrange curve with parameters set by hand."""
    points = tuple(Point(x, y, t=t) for (x, y), t in zip(points, parameters, strict=True))
    return Curve(name, LAGRANGE, Parametrization(MANUAL), points, **other)


def five_points():
    """Few points: the functions can be told apart."""
    return lagrange("Five points", [(0.0, 0.0), (1.0, 1.6), (2.4, 1.9), (3.6, 0.7), (5.0, 1.3)])


def eleven_points():
    """Nearly straight points, below the other curve; the polynomial swings at the ends."""
    heights = (-1.3, -1.15, -1.35, -1.2, -1.3, -1.1, -1.3, -1.2, -1.35, -1.15, -1.3)
    points = [(i / 2, y) for i, y in enumerate(heights)]
    return lagrange("Eleven points", points, style=Style(stroke=BLUE))


def three_parameter_sets():
    """Nearly the same points; the second and third set of times goes less and less with the distances."""
    points = [(0.0, 0.0), (1.0, 1.2), (2.0, 1.6), (3.0, 1.2), (4.2, 0.4), (5.2, 1.0), (6.0, 2.2)]
    lower = [(x + 0.02, y - 0.04) for x, y in points]
    upper = [(x - 0.03, y + 0.03) for x, y in points]
    return (
        timed("In step", points, [0.0, 0.2, 0.34, 0.48, 0.66, 0.81, 1.0], style=Style(stroke=BLUE)),
        timed("Out of step", lower, [0.0, 0.2, 0.31, 0.5, 0.62, 0.8, 1.0], style=Style(stroke=ORANGE)),
        timed("Careless", upper, [0.0, 0.05, 0.36, 0.4, 0.72, 0.76, 1.0], style=Style(stroke=VERMILLION)),
    )


def uneven():
    """Two groups of near points, and a long way between them."""
    return lagrange(
        "Uneven", [(0.0, 0.0), (0.5, 0.1), (1.0, 0.0), (5.0, 2.2), (5.4, 2.2), (5.8, 2.0), (6.2, 2.1)]
    )


def eight_points():
    """On the interval from 0 to 7, where four digits are too few for monomials and enough for the others."""
    points = [
        (0.0, 0.4), (1.1, 1.7), (2.3, 2.1), (3.2, 1.2),
        (4.4, 0.3), (5.5, 0.8), (6.3, 2.2), (7.6, 2.6),
    ]  # fmt: skip
    return lagrange("Eight points", points, end=7.0)


def nine_points(end):
    """Uniform parameters: Λ is 11. Up to t = 8 powers of t grow a long way."""
    points = [
        (0.0, 0.0), (1.0, 1.1), (2.0, 1.6), (3.1, 1.3), (4.0, 0.5),
        (5.1, 0.2), (6.0, 0.8), (7.0, 1.7), (8.0, 1.9),
    ]  # fmt: skip
    return lagrange("Nine points", points, end=end)


def stations():
    """A move from rest to rest in four seconds, through three stations; above it the same of degree five."""
    still = (0.0, 0.0)
    places = [(0.0, 0.0), (0.6, 0.9), (1.8, 1.0), (2.6, 0.3), (3.6, 0.2)]
    velocities = [still, (1.1, 0.7), (1.1, -0.4), (0.8, -0.5), still]
    accelerations = [still, (0.3, -0.8), (-0.2, -0.7), (0.2, 0.6), still]
    rule = Parametrization(UNIFORM, end=4.0)
    cubic = tuple(Point(*place, velocity=v) for place, v in zip(places, velocities, strict=True))
    quintic = tuple(
        Point(x, y + 1.6, velocity=v, acceleration=a)
        for (x, y), v, a in zip(places, velocities, accelerations, strict=True)
    )
    return (
        Curve("Cubic", HERMITE, rule, cubic),
        Curve("Quintic", QUINTIC_HERMITE, rule, quintic, style=Style(stroke=BLUE)),
    )


def wave(name, count, level):
    """Points up and down, `count` of them."""
    points = [(10.0 * i / (count - 1), level + (0.6 if i % 4 in (1, 2) else 0.0)) for i in range(count)]
    return lagrange(name, points, ParametrizationKind.CHEBYSHEV, style=Style(stroke=BLUE if level else ""))


SIX_POINTS = [(0.0, 0.0), (0.8, 1.5), (1.6, 1.9), (4.3, 1.6), (5.0, 0.4), (6.8, 0.0)]
FAR_POINT = [(0.0, 0.0), (0.7, 0.5), (1.4, 0.6), (3.2, 5.0), (2.6, 0.7), (3.3, 0.5), (4.0, 0.1)]


def exercise(points):
    """The same points twice, at equal steps; the parameters of the second curve are the reader's to set."""
    steps = [i / (len(points) - 1) for i in range(len(points))]
    yours = timed("Yours", points, steps, style=Style(stroke=VERMILLION))
    return (lagrange("Equal steps", points, style=Style(stroke=BLUE)), yours)


def bells():
    """Runge's function at even steps, twice: one polynomial, and below it a curve that blends some."""
    bell = [(x / 5, 1.0 / (1.0 + x * x)) for x in range(-5, 6)]
    below = lagrange("Blend", [(x, y - 1.5) for x, y in bell], style=Style(stroke=BLUE))
    return (lagrange("Bell", bell), replace(below, family=FAMILIES.named("floater_hormann")))


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    for stem, document in lessons().items():
        save(FOLDER / f"{stem}.curve.json", document)
