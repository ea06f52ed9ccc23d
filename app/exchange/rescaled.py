"""Documents in another unit of length, of the same size on paper."""

from __future__ import annotations

from msgspec.structs import replace

from ..document.derivatives import VECTORS
from ..document.model import Curve, Document, Page, Point
from .units import MILLIMETRES, known_unit


def factor_between(unit: str, other: str) -> float:
    """Return how many of the other unit one of the first is; 1 where either is no length."""
    here, there = known_unit(unit), known_unit(other)
    return MILLIMETRES[here] / MILLIMETRES[there] if here and there and here != there else 1.0


def in_unit(document: Document, unit: str) -> Document:
    """Return the document in a unit, its picture to trace aside; as it is where either is no length."""
    factor = factor_between(document.unit, unit)
    if factor == 1.0:
        return document
    return replace(enlarged(document, factor), unit=unit)


def enlarged(document: Document, factor: float) -> Document:
    """Return the document so many times as large, its picture to trace aside."""
    curves = tuple(_scaled_curve(curve, factor) for curve in document.curves)
    page = document.page and Page(*(value * factor for value in _sides(document.page)))
    guides = tuple(replace(guide, position=guide.position * factor) for guide in document.guides)
    spacing = document.grid_spacing * factor
    return replace(document, curves=curves, page=page, guides=guides, grid_spacing=spacing)


def _sides(page: Page) -> tuple[float, float, float, float]:
    return page.x, page.y, page.width, page.height


def _scaled_curve(curve: Curve, factor: float) -> Curve:
    points = tuple(_scaled_point(point, factor) for point in curve.points)
    style = curve.style.mapped(lambda place: (place[0] * factor, place[1] * factor))
    if style.width is not None:
        style = replace(style, width=style.width * factor)
    return replace(curve, points=points, style=style)


def _scaled_point(point: Point, factor: float) -> Point:
    vectors = {
        name: (vector[0] * factor, vector[1] * factor)
        for _, name in VECTORS
        if (vector := getattr(point, name)) is not None
    }
    return replace(point, x=point.x * factor, y=point.y * factor, **vectors)
