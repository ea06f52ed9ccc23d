"""Requirements of a document that go beyond types."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import chain
from operator import attrgetter

from ..document.derivatives import VECTORS
from ..document.export import NEVER_EXPORTED, Export
from ..document.model import (
    MAX_MAGNITUDE,
    Curve,
    Document,
    Page,
    ParametrizationKind,
    Point,
    ReferenceImage,
    Vector,
)
from ..document.shapes import shape_problem
from ..document.ties import holds
from .format_error import FormatError, quoted
from .number_check import check_number
from .style_check import validate_style

LONGEST_UNIT = 12
LONGEST_NAME, LONGEST_OPTION = 255, 1000
MOST_OPTIONS = 64


def validate(document: Document) -> None:
    """Raise FormatError, with the place, unless `document` may be saved.

    A document has at least one curve. Every number is finite, its magnitude at most `MAX_MAGNITUDE`.
    A parametrization has start < end and alpha in [0, 1]. The parameters that the points carry increase
    strictly in the order of the points, also where a rule is in force and they are only remembered; under
    the manual parametrization every point carries one. Tied velocities are both there, and parallel. A curve
    may have one point or none. An image has a path to a file of this computer, a positive size and an opacity
    in [0, 1]. The curves of a shape follow each other and look the same.
    """
    if not document.curves:
        raise FormatError("curves must hold at least one curve")
    for index, curve in enumerate(document.curves):
        _validate_curve(curve, f"curves[{index}]")
    if document.image is not None:
        _validate_image(document.image)
    _validate_plane(document)
    _validate_export(document.export)
    if problem := shape_problem(document):
        raise FormatError(problem)


def validate_changes(before: Document, after: Document) -> None:
    """Raise FormatError, as `validate` does, for what in `after` is not the same object as in `before`."""
    known = {id(curve) for curve in before.curves}
    for index, curve in enumerate(after.curves):
        if id(curve) not in known:
            _validate_curve(curve, f"curves[{index}]")
    if after.image is not None and after.image is not before.image:
        _validate_image(after.image)
    _validate_plane(after)
    _validate_export(after.export)


def _validate_export(export: Export) -> None:
    """Raise FormatError unless a document may be kept with an export."""
    if export is NEVER_EXPORTED:
        return
    name = export.name
    if len(name) > LONGEST_NAME or not name.isprintable() or "/" in name or "\\" in name:
        raise FormatError(f"export.name must be the name of a file without its folder, not {quoted(name)}")
    if len(export.ending) > LONGEST_NAME or not export.ending.isprintable():
        raise FormatError(f"export.ending must be the end of a name, not {quoted(export.ending)}")
    if len(export.options) > MOST_OPTIONS:
        raise FormatError(f"export.options must be at most {MOST_OPTIONS}, not {len(export.options)}")
    for index, texts in enumerate(export.options):
        if not all(len(text) <= LONGEST_OPTION and text.isprintable() for text in texts):
            raise FormatError(
                f"export.options[{index}] must be printable texts of at most {LONGEST_OPTION} characters"
            )


def _validate_plane(document: Document) -> None:
    """Raise FormatError unless unit, grid and guides are such as a document may have."""
    if len(document.unit) > LONGEST_UNIT or not document.unit.isprintable():
        raise FormatError(
            f"unit must be a name of at most {LONGEST_UNIT} characters, not {quoted(document.unit)}"
        )
    check_number(document.grid_spacing, "grid_spacing")
    if document.grid_spacing < 0:
        raise FormatError(f"grid_spacing must be 0 or greater, not {document.grid_spacing!r}")
    for index, guide in enumerate(document.guides):
        check_number(guide.position, f"guides[{index}].position")
    if document.page is not None:
        _validate_box(document.page, "page", ("x", "y", "width", "height"))


def _validate_box(box: ReferenceImage | Page, place: str, keys: Sequence[str]) -> None:
    """Raise FormatError unless these values are numbers, and the size is positive."""
    for key in keys:
        check_number(getattr(box, key), f"{place}.{key}")
    for key in ("width", "height"):
        if not getattr(box, key) > 0:
            raise FormatError(f"{place}.{key} must be greater than 0, not {getattr(box, key)!r}")


def _validate_image(image: ReferenceImage) -> None:
    _validate_box(image, "image", ("x", "y", "width", "height", "opacity"))
    if not 0 <= image.opacity <= 1:
        raise FormatError(f"image.opacity must lie between 0 and 1, not {image.opacity!r}")
    if not image.path.strip() or not image.path.isprintable():
        raise FormatError(f"image.path must be the name of a file, not {quoted(image.path)}")
    if image.path.startswith(("//", "\\\\")):
        # Opening one would knock at another computer, and on some systems with the person's password.
        raise FormatError("image.path must lead to a file of this computer, not to one of the network")


def _validate_curve(curve: Curve, place: str) -> None:
    for key, text in (("name", curve.name), ("shape", curve.shape), ("groups", "".join(curve.groups))):
        try:
            text.encode("utf-8")
        except UnicodeEncodeError:
            raise FormatError(f"{place}.{key} holds a character that UTF-8 cannot carry") from None
    rule = curve.parametrization
    for key in ("alpha", "start", "end"):
        check_number(getattr(rule, key), f"{place}.parametrization.{key}")
    if not 0 <= rule.alpha <= 1:
        raise FormatError(f"{place}.parametrization.alpha must lie between 0 and 1, not {rule.alpha!r}")
    if not rule.start < rule.end:
        raise FormatError(
            f"{place}.parametrization.end must be greater than {rule.start!r}, the start, not {rule.end!r}"
        )
    validate_style(curve.style, f"{place}.style")
    _validate_ties(curve, place)
    if not _all_within(curve.points):
        for index, point in enumerate(curve.points):
            for key, value in _numbers(point):
                check_number(value, f"{place}.points[{index}].{key}")
    _validate_parameters(curve, place)


def _validate_ties(curve: Curve, place: str) -> None:
    """Raise FormatError unless tied velocities are both there, in one direction."""
    if not any(map(attrgetter("tied"), curve.points)):
        return
    for index, point in enumerate(curve.points):
        if point.tied and not (type(point.tied) is bool and holds(point)):
            raise FormatError(
                f"{place}.points[{index}].tied needs a corner, velocity and velocity_after in one direction"
            )


def _numbers(point: Point) -> Iterator[tuple[str, float]]:
    """Yield every number of the point with its place in it."""
    yield "x", point.x
    yield "y", point.y
    if point.t is not None:
        yield "t", point.t
    for _, key in VECTORS:
        vector: Vector | None = getattr(point, key)
        for index, value in enumerate(vector or ()):
            yield f"{key}[{index}]", value


def _validate_parameters(curve: Curve, place: str) -> None:
    """Raise FormatError unless the parameters that the points carry increase strictly."""
    # No list of pairs: of a million points it would take half of what these take themselves.
    times = [point.t for point in curve.points]
    if curve.is_manual and None in times:
        raise FormatError(
            f"{place}.points[{times.index(None)}].t is missing; "
            f'under "{ParametrizationKind.MANUAL}" every point carries its parameter'
        )
    before, low = -1, None
    for index, high in enumerate(times):
        if high is None:
            continue
        if low is not None and not low < high:
            whose = "the point before it" if before == index - 1 else f"points[{before}]"
            raise FormatError(
                f"{place}.points[{index}].t must be greater than {low!r}, the t of {whose}, not {high!r}"
            )
        before, low = index, high
    if curve.closed and curve.is_manual and low is not None and not low < curve.parametrization.end:
        raise FormatError(
            f"{place}.parametrization.end must be greater than {low!r}, the t of the last point: "
            "there the closed curve returns to its first point"
        )


def _all_within(points: tuple[Point, ...]) -> bool:
    """Whether all numbers of points are floats that may be saved, at one look: one by one takes too long.

    Where it is not so, somebody must look which is not.
    """
    return all(map(_are_plain, _columns(points)))


def _columns(points: tuple[Point, ...]) -> Iterator[list[float]]:
    yield list(map(attrgetter("x"), points))
    yield list(map(attrgetter("y"), points))
    yield [t for t in map(attrgetter("t"), points) if t is not None]
    for _, name in VECTORS:
        # A vector of two numbers is true, whatever they are.
        yield list(chain.from_iterable(filter(None, map(attrgetter(name), points))))


def _are_plain(values: list[float]) -> bool:
    if not values:
        return True
    # A sum is NaN if anything is, while min and max may pass it over.
    are_floats = set(map(type, values)) == {float} and not math.isnan(sum(values))
    return are_floats and min(values) >= -MAX_MAGNITUDE and max(values) <= MAX_MAGNITUDE
