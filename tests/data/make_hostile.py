"""Makes ``tests/data/hostile``: files that no program should trust.

Run it after a change here: ``python tests/data/make_hostile.py``. What is too large to be kept is made by
the test when it needs it.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

FOLDER = Path(__file__).parent / "hostile"
LARGEST_KEPT = 4096

POINTS = '{"x": 0.0, "y": 0.0}, {"x": 1.0, "y": 2.0}'
RULE = '{"kind": "chord_length", "alpha": 0.5, "start": 0.0, "end": 1.0}'


def curve(
    points: str = POINTS, rule: str = RULE, family: str = '"lagrange"', name: str = '"a"', more: str = ""
) -> str:
    return f'{{"name": {name}, "family": {family}, "parametrization": {rule}, "points": [{points}]{more}}}'


def document(curves: str | None = None, version: str = "3", **parts: str) -> bytes:
    body = curve(**parts) if curves is None else curves
    return f'{{"format": "curvebench", "version": {version}, "curves": [{body}]}}'.encode()


def point(**values: str) -> bytes:
    fields = {"x": "3.0", "y": "1.0"} | values
    text = ", ".join(f'"{key}": {value}' for key, value in fields.items())
    return document(points=f"{POINTS}, {{{text}}}")


def manual(*parameters: float) -> bytes:
    rule = RULE.replace("chord_length", "manual")
    points = ", ".join(f'{{"x": {i}.0, "y": 1.0, "t": {t!r}}}' for i, t in enumerate(parameters))
    return document(points=points, rule=rule)


def svg(body: str) -> bytes:
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink">'
        + body
        + "</svg>"
    ).encode()


def dxf(*entities: str, end: str = "0\nENDSEC\n0\nEOF\n") -> bytes:
    return ("0\nSECTION\n2\nENTITIES\n" + "".join(entities) + end).encode()


def spline(knots: str = "0 0 0 0 1 1 1 1", points: str = "0,0 1,1 2,0 3,1", degree: str = "3") -> str:
    head = f"0\nSPLINE\n5\n1F\n100\nAcDbEntity\n8\n0\n100\nAcDbSpline\n70\n8\n71\n{degree}\n"
    body = "".join(f"40\n{knot}\n" for knot in knots.split())
    for pair in points.split():
        x, y = pair.split(",")
        body += f"10\n{x}\n20\n{y}\n30\n0\n"
    return head + body


WRONG_TYPES = {
    "x": point(x='"3"'),
    "y": point(y="null"),
    "t": point(t="true"),
    "velocity": point(velocity="[1]"),
    "acceleration": point(acceleration='{"x": 1}'),
    "jerk": point(jerk="[1, 2, 3]"),
    "jerk_rule": document(more=', "jerk_rule": "bessel"'),
    "corner": point(corner="1"),
    "name": document(name="7"),
    "family": document(family='"spline"'),
    "rule": document(rule='"chord_length"'),
    "kind": document(rule=RULE.replace('"chord_length"', "3")),
    "alpha": document(rule=RULE.replace("0.5", "[]")),
    "start": document(rule=RULE.replace("0.0", '""')),
    "closed": document(more=', "closed": 0'),
    "colour": document(more=', "style": {"stroke": "red"}'),
    "point": document(points="7"),
    "curve": document(curves="7"),
}

GOOD = document()

JSON: dict[str, Callable[[], bytes]] = {
    "zero_bytes": lambda: b"",
    "blank": lambda: b" \n\n",
    "byte_order_mark": lambda: b"\xef\xbb\xbf" + GOOD,
    "utf_16": lambda: GOOD.decode().encode("utf-16"),
    "bad_utf_8": lambda: GOOD.replace(b'"a"', b'"\xff\xfe"'),
    "trailing_nul": lambda: GOOD + b"\0",
    "truncated": lambda: GOOD[: len(GOOD) // 2],
    "two_documents": lambda: GOOD + GOOD,
    "malformed": lambda: GOOD.replace(b":", b"=", 1),
    "a_list": lambda: b"[" + GOOD + b"]",
    "another_format": lambda: GOOD.replace(b"curvebench", b"benchcurve"),
    "version_0": lambda: document(version="0"),
    "version_newer": lambda: document(version="9"),
    "version_text": lambda: document(version='"1"'),
    "no_curves": lambda: document(curves=""),
    "one_point": lambda: document(points='{"x": 0.0, "y": 0.0}'),
    "infinite": lambda: point(x="1e999"),
    "nan": lambda: point(x="NaN"),
    "infinity": lambda: point(x="-Infinity"),
    "too_large": lambda: point(x="1e308"),
    "coincident": lambda: document(points='{"x": 0.0, "y": 0.0}, {"x": 0.0, "y": 0.0}'),
    "equal_parameters": lambda: manual(0.0, 0.5, 0.5, 1.0),
    "decreasing_parameters": lambda: manual(0.0, 0.5, 0.25, 1.0),
    "unknown_key": lambda: point(z="1.0"),
    "duplicate_key": lambda: point(x='1.0, "x": 2.0'),
    "lone_surrogate": lambda: document(name='"\\ud800"'),
    "nested": lambda: GOOD.replace(b"1.0", b"[" * 100_000),
    "nested_objects": lambda: GOOD.replace(b'"a"', b'{"a":' * 100_000),
    "million_digits": lambda: point(x="1" * 1_000_000),
    "million_digit_version": lambda: document(version="1" * 1_000_000),
    "million_points": lambda: document(
        points=", ".join(f'{{"x": {i}.0, "y": 0.5}}' for i in range(1_000_000))
    ),
    **{f"wrong_type_{field}": lambda data=data: data for field, data in WRONG_TYPES.items()},  # type: ignore[misc]
}

CSV: dict[str, Callable[[], bytes]] = {
    "zero_bytes": lambda: b"",
    "titles_only": lambda: b"x,y\n",
    "ragged": lambda: b"x,y\n0,1\n1,2,3\n",
    "short_row": lambda: b"x,y\n0,1\n1\n",
    "formula": lambda: b"x,y\n0,1\n=cmd|' /C calc'!A0,2\n",
    "formula_at": lambda: b"x,y\n0,1\n@SUM(1+1)*cmd|' /C calc'!A0,2\n",
    "power_tower": lambda: b"x,y\n0,1\n9**9**9,2\n",
    "import": lambda: b"x,y\n0,1\n__import__('os').system('true'),2\n",
    "nan": lambda: b"x,y\n0,1\nnan,2\n",
    "infinity": lambda: b"x,y\n0,1\n-inf,2\n",
    "infinite": lambda: b"x,y\n0,1\n1e999,2\n",
    "zero_byte": lambda: b"x,y\n0,1\n\0,2\n",
    "bad_utf_8": lambda: b"x,y\n0,1\n\xc3\x28,2\n",
    "half_utf_16": lambda: "0,1\n1,2\n".encode("utf-16") + b"1",
    "open_quote": lambda: b'x,y\n0,1\n"1,2\n',
    "one_row": lambda: b"x,y\n0,1\n",
    "one_column": lambda: b"x\n0\n1\n",
    "falling_t": lambda: b"t,x,y\n0,1,2\n1,2,3\n0.5,3,4\n",
    "coincident": lambda: b"x,y\n1,1\n1,1\n",
    "two_decimal_commas": lambda: b"1,5;2,5\n1,2,3;4\n",
    "picture": lambda: b"\x89PNG\r\n\x1a\n" + bytes(range(256)),
    "bad_last_row": lambda: b"x,y\n" + b"0.125,0.25\n" * 1_000_000 + b"0.5;1\n",
    "one_long_line": lambda: b"1," * 2_000_000,
    "million_digits": lambda: b"x,y\n0,1\n" + b"1" * 1_000_000 + b",2\n",
}

SVG: dict[str, Callable[[], bytes]] = {
    "zero_bytes": lambda: b"",
    "two_doctypes": lambda: b"<!DOCTYPE svg><!DOCTYPE svg>" + svg('<path d="M0 0L1 1"/>'),
    "doctype_in_a_doctype": lambda: b'<!DOCTYPE svg SYSTEM "<!DOCTYPE">' + svg('<path d="M0 0L1 1"/>'),
    "external_dtd": lambda: b'<!DOCTYPE svg SYSTEM "file:///dev/random">' + svg('<path d="M0 0L1 1&a;"/>'),
    "internal_subset": lambda: b"<!DOCTYPE svg [<!ATTLIST path d CDATA #FIXED 'M0 0L1 1'>]>" + svg("<path/>"),
    "parameter_entity": lambda: (
        b'<!DOCTYPE svg [<!ENTITY % a SYSTEM "file:///etc/passwd">%a;]>' + svg('<path d="M0 0L1 1"/>')
    ),
    "entities": lambda: (
        b'<!DOCTYPE svg [<!ENTITY a "M0 0L1 1"><!ENTITY b "&a;&a;&a;"><!ENTITY c "&b;&b;&b;">]>'
        + svg('<path d="&c;"/>')
    ),
    "external_entity": lambda: (
        b'<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]>' + svg("<title>&a;</title>")
    ),
    "unknown_entity": lambda: svg("<title>&nbsp;</title>"),
    "use_of_itself": lambda: svg('<use id="a" href="#a"/>'),
    "use_loop": lambda: svg('<g id="a"><use xlink:href="#b"/></g><g id="b"><use xlink:href="#a"/></g>'),
    "use_doubling": lambda: svg(
        "".join(f'<g id="g{i}"><use href="#g{i + 1}"/><use href="#g{i + 1}"/></g>' for i in range(30))
        + '<path id="g30" d="M0 0L1 1"/>'
    ),
    "nan": lambda: svg('<path d="M0 0L NaN 1"/>'),
    "infinite": lambda: svg('<path d="M0 0L 1e999 1"/>'),
    "too_large": lambda: svg('<path d="M0 0L 1e200 1"/>'),
    "infinite_by_transform": lambda: svg('<path transform="scale(1e300) scale(1e300)" d="M0 0L 1 1"/>'),
    "arc_with_wrong_flag": lambda: svg('<path d="M0 0A1 1 0 2 1 3 3"/>'),
    "arc_cut_off": lambda: svg('<path d="M0 0A1 1 0 1"/>'),
    "arc_beyond_numbers": lambda: svg('<path d="M0 0A1e308 1e-308 0 1 1 1e300 1e300"/>'),
    "no_moveto": lambda: svg('<path d="C1 1 2 2 3 3"/>'),
    "numbers_after_z": lambda: svg('<path d="M0 0L1 1Z 4 4"/>'),
    "broken_transform": lambda: svg('<path transform="rotate(1 2)" d="M0 0L1 1"/>'),
    "radius_of_words": lambda: svg('<circle r="large"/>'),
    "odd_points": lambda: svg('<polygon points="0 0 1 1 2"/>'),
    "point_only": lambda: svg('<path d="M5 5z"/>'),
    "nothing": lambda: svg(""),
    "foreign_file": lambda: svg('<image href="file:///etc/passwd"/><use href="http://localhost/#a"/>'),
    "unclosed": lambda: svg("<g>"),
    "unknown_encoding": lambda: b"<?xml version='1.0' encoding='klingon'?>" + svg(""),
    "html": lambda: b"<html><body/></html>",
    "picture": lambda: b"\x89PNG\r\n\x1a\n" + bytes(range(256)),
    "many_elements": lambda: svg("<g/>" * 10_001),
    "deep": lambda: svg("<g>" * 100_000),
    "million_digits": lambda: svg(f'<path d="M0 0L1 {"1" * 1_000_000}"/>'),
    "many_pieces": lambda: svg('<path d="M0 0' + "L1 1 0 0" * 50_001 + '"/>'),
    "wide_attributes": lambda: svg("<g " + " ".join(f'a{i}=""' for i in range(100_000)) + "/>"),
}

DXF: dict[str, Callable[[], bytes]] = {
    "zero_bytes": lambda: b"",
    "truncated": lambda: dxf(spline(), end=""),
    "truncated_in_a_number": lambda: dxf(spline())[:-30],
    "binary": lambda: b"AutoCAD Binary DXF\r\n\x1a\0\0\0",
    "words": lambda: b"hello\nworld\n0\nEOF\n",
    "codes_without_values": lambda: b"0\nSECTION\n2\n0\nEOF\n",
    "no_entities": dxf,
    "nan": lambda: dxf(spline(points="0,0 nan,1 2,0 3,1")),
    "infinite": lambda: dxf(spline(points="0,0 1e999,1 2,0 3,1")),
    "number_of_words": lambda: dxf(spline(points="0,0 one,1 2,0 3,1")),
    "too_large": lambda: dxf(spline(points="0,0 1e200,1 2,0 3,1")),
    "too_few_knots": lambda: dxf(spline(knots="0 0 1 1")),
    "falling_knots": lambda: dxf(spline(knots="0 0 0 0 1 1 1 0")),
    "equal_knots": lambda: dxf(spline(knots="0 0 0 0 0 0 0 0")),
    "nan_knots": lambda: dxf(spline(knots="0 0 0 0 nan 1 1 1")),
    "degree_of_words": lambda: dxf(spline(degree="three")),
    "circle_without_radius": lambda: dxf("0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n0\n"),
    "line_to_nan": lambda: dxf("0\nLINE\n8\n0\n10\n0\n20\n0\n11\nnan\n21\n1\n"),
    "text_only": lambda: dxf("0\nTEXT\n8\n0\n10\n0\n20\n0\n40\n1\n1\nhi\n"),
    "many_entities": lambda: dxf("0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1\n21\n1\n" * 10_001),
    "million_digits": lambda: dxf(spline(points=f"0,0 {'1' * 1_000_000},1 2,0 3,1")),
}

CASES = {
    f"{name}{ending}": make
    for ending, cases in ((".curve.json", JSON), (".csv", CSV), (".svg", SVG), (".dxf", DXF))
    for name, make in cases.items()
}


def kept() -> dict[str, bytes]:
    """The cases that are small enough to be kept."""
    made = {name: make() for name, make in CASES.items()}
    return {name: data for name, data in made.items() if len(data) <= LARGEST_KEPT}


def main() -> None:
    FOLDER.mkdir(exist_ok=True)
    for old in FOLDER.iterdir():
        old.unlink()
    for name, data in kept().items():
        (FOLDER / name).write_bytes(data)


if __name__ == "__main__":
    main()
