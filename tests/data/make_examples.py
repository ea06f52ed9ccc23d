"""Makes the documents of resources/examples: run `python tests/data/make_examples.py` after a change here.

A test compares the files with what this makes, bit for bit; values that come from sine and cosine are
rounded to 12 decimals, because mathematical libraries differ in the last bit.
"""

import math
from pathlib import Path

from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.storage.files import save

FOLDER = Path(__file__).parents[2] / "resources" / "examples"


def examples():
    """Return the documents by the stem of their file."""
    return {
        "letter_s": Document((letter_s(),)),
        "runge_uniform": Document((runge_uniform(),)),
        "runge_chebyshev": Document((runge_chebyshev(),)),
        "robot_move": Document((robot_move(),)),
        "airfoil_naca": Document((airfoil_naca(),)),
    }


def letter_s():
    """A letter as sketched by hand; the ends have velocities of their own, so that they curl."""
    places = [
        (5.6, 8.2), (3.6, 9.9), (1.0, 8.9), (0.85, 6.7), (3.3, 5.1),
        (5.85, 3.3), (5.5, 0.95), (2.9, -0.05), (0.35, 2.0),
    ]  # fmt: skip
    points = [Point(x, y) for x, y in places]
    points[0] = Point(*places[0], velocity=(-7.0, 20.0))
    points[-1] = Point(*places[-1], velocity=(-6.0, 22.0))
    return Curve("Letter S", HERMITE, Parametrization(), tuple(points))


def runge(x):
    """Runge's function, which polynomials through uniform points fail to approach."""
    return 1.0 / (1.0 + 25.0 * x * x)


def runge_uniform():
    """The interpolant at 11 uniform points: it swings widely near the ends."""
    return _runge_curve("Runge, uniform", ParametrizationKind.UNIFORM, [i / 5 - 1 for i in range(11)])


def runge_chebyshev():
    """The interpolant at 11 Chebyshev points of the second kind: it stays calm."""
    abscissae = [_rounded(-math.cos(math.pi * i / 10)) for i in range(11)]
    return _runge_curve("Runge, Chebyshev", ParametrizationKind.CHEBYSHEV, abscissae)


def _runge_curve(name, kind, abscissae):
    """On the interval [-1, 1], x equals t: the curve is the graph of the interpolant."""
    points = tuple(Point(x, runge(x)) for x in abscissae)
    return Curve(name, LAGRANGE, Parametrization(kind, start=-1.0, end=1.0), points)


def robot_move():
    """A pick-and-place move in metres, in 2.5 s, from rest to rest; a via point every half second."""
    still = (0.0, 0.0)
    points = (
        Point(0.0, 0.0, velocity=still, acceleration=still),
        Point(0.02, 0.18),
        Point(0.22, 0.43),
        Point(0.58, 0.45),
        Point(0.78, 0.27),
        Point(0.8, 0.12, velocity=still, acceleration=still),
    )
    rule = Parametrization(ParametrizationKind.UNIFORM, start=0.0, end=2.5)
    return Curve("Robot move", QUINTIC_HERMITE, rule, points)


def airfoil_naca(camber=0.02, position=0.4, thickness=0.12, count=41):
    """NACA 2412 from the trailing edge over the top to the nose and back below, chord 1.

    Formulas: Jacobs, Ward, Pinkerton, NACA Report 460 (1933), with the last coefficient of the thickness
    changed from -0.1015 to -0.1036, which closes the trailing edge. Cosine spacing.
    """
    points = tuple(
        Point(
            *(
                _rounded(value)
                for value in _naca_point(2 * math.pi * i / (count - 1), camber, position, thickness)
            )
        )
        for i in range(count)
    )
    return Curve("NACA 2412", HERMITE, Parametrization(), points)


def _naca_point(angle, camber, position, thickness):
    """Return the point of the outline at an angle around the circle over the chord."""
    x = (1 + math.cos(angle)) / 2
    half = 5 * thickness * (
        0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4
    )  # fmt: skip
    reach = position if x < position else 1 - position
    mean = camber / reach**2 * (2 * position * x - x**2 + (0 if x < position else 1 - 2 * position))
    slope = math.atan(2 * camber / reach**2 * (position - x))
    side = 1 if angle <= math.pi else -1
    return x - side * half * math.sin(slope), mean + side * half * math.cos(slope)


def _rounded(value):
    """Return the value without the bits in which mathematical libraries differ, and without -0.0."""
    return round(value, 12) + 0.0


def main():
    """Write every example."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for stem, document in examples().items():
        save(FOLDER / f"{stem}.curve.json", document)


if __name__ == "__main__":
    main()
