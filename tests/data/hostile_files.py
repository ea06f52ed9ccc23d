"""Files that no program should trust: those of ``hostile``, and those that are too large to be kept there."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

FOLDER = Path(__file__).parent / "hostile"


def document(*, name: str = '"a"', x: str = "0.0", points: str | None = None, version: str = "4") -> bytes:
    if points is None:
        points = f'{{"x": {x}, "y": 0.0}}, {{"x": 1.0, "y": 2.0}}, {{"x": 3.0, "y": 1.0}}'
    rule = '{"kind": "chord_length", "alpha": 0.5, "start": 0.0, "end": 1.0}'
    curve = f'{{"name": {name}, "family": "lagrange", "parametrization": {rule}, "points": [{points}]}}'
    return f'{{"format": "curvebench", "version": {version}, "curves": [{curve}]}}'.encode()


def svg(body: str) -> bytes:
    return f'<svg xmlns="http://www.w3.org/2000/svg">{body}</svg>'.encode()


def dxf(entities: str) -> bytes:
    return f"0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n".encode()


def spline(x: str) -> str:
    head = "0\nSPLINE\n5\n1F\n100\nAcDbEntity\n8\n0\n100\nAcDbSpline\n70\n8\n71\n3\n"
    knots = "".join(f"40\n{knot}\n" for knot in (0, 0, 0, 0, 1, 1, 1, 1))
    points = "".join(f"10\n{x}\n20\n{y}\n30\n0\n" for x, y in (("0", 0), (x, 1), ("2", 0), ("3", 1)))
    return head + knots + points


DIGITS = "1" * 1_000_000
ROWS = 200_000

LARGE: dict[str, Callable[[], bytes]] = {
    "nested.curve.json": lambda: document(x="[" * 100_000),
    "nested_objects.curve.json": lambda: document(name='{"a":' * 100_000),
    "million_digits.curve.json": lambda: document(x=DIGITS),
    "million_digit_version.curve.json": lambda: document(version=DIGITS),
    "very_many_points.curve.json": lambda: document(
        points=", ".join(f'{{"x": {i}.0, "y": 0.5}}' for i in range(ROWS))
    ),
    "bad_last_row.csv": lambda: b"x,y\n" + b"0.125,0.25\n" * ROWS + b"0.5;1\n",
    "one_long_line.csv": lambda: b"1," * 2_000_000,
    "million_digits.csv": lambda: b"x,y\n0,1\n" + DIGITS.encode() + b",2\n",
    "many_elements.svg": lambda: svg("<g/>" * 10_001),
    "deep.svg": lambda: svg("<g>" * 100_000),
    "million_digits.svg": lambda: svg(f'<path d="M0 0L1 {DIGITS}"/>'),
    "many_pieces.svg": lambda: svg('<path d="M0 0' + "L1 1 0 0" * 50_001 + '"/>'),
    "wide_attributes.svg": lambda: svg("<g " + " ".join(f'a{i}=""' for i in range(100_000)) + "/>"),
    "quadratic_entities.svg": lambda: (
        f'<!DOCTYPE svg [<!ENTITY a "{"x" * 60_000}">]>'.encode() + svg(f'<g id="{"&a;" * 200_000}"/>')
    ),
    "quadratic_defaults.svg": lambda: (
        f'<!DOCTYPE svg [<!ENTITY a "{"x" * 60_000}"><!ATTLIST g id CDATA "{"&a;" * 200_000}">]>'.encode()
        + svg("")
    ),
    "default_values.svg": lambda: (
        f'<!DOCTYPE svg [<!ATTLIST g id CDATA "{"x" * 60_000}">]>'.encode() + svg("<g/>" * 9000)
    ),
    "many_entities.dxf": lambda: dxf("0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1\n21\n1\n" * 10_001),
    "million_digits.dxf": lambda: dxf(spline(DIGITS)),
}

CASES: dict[str, Callable[[], bytes]] = {
    **{path.name: path.read_bytes for path in sorted(FOLDER.iterdir())},
    **LARGE,
}
