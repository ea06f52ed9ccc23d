"""Objects made a pattern, and patterns made objects."""

from __future__ import annotations

from msgspec.structs import replace

from ... import exchange
from ...actions.declaration import action
from ...actions.needs import HIGHLIGHTED, Need
from ...actions.sections import CURVE_PATTERNS
from ...actions.situation import Situation
from ...document.curve_tree import Container
from ...document.form_edits import formed_anew
from ...document.forms import Rectangle
from ...document.gradient import Gradient, GradientKind
from ...document.model import Document, Page, make_curve
from ...document.patterns import colouring
from ...document.several_curves import (
    add_curves,
    named,
    remove_curves,
    whole_curves,
)
from ...document.shape_edits import free_group_name
from ...document.shapes import shape_of, whole_shapes
from ...document.style import GRADIENTS, NO_PAINT, Style
from ...document.style_edits import colours_of, with_style
from ...document.words import count_of
from ...exchange.errors import ExchangeError
from ...session import Session
from ...view_model.boxes.bounds import Bounds, Strokes, bounds_of
from ...workbench.context import WindowContext

_BLACK = "#000000"


def _has_pattern(now: Situation) -> bool:
    curves = now.session.document.curves
    return any(
        curves[place].style.is_placed and _tiles(curves[place].style) for place in now.session.selected.marked
    )


def _tiles(style: Style) -> list[tuple[str, Gradient]]:
    """Return the paints of a style that are patterns, and these."""
    return [
        (paint, gradient)
        for paint, field in GRADIENTS.items()
        if (gradient := style.gradients.get(field)) is not None and gradient.tile is not None
    ]


def _patterned(session: Session) -> list[tuple[int, str, Gradient]]:
    """Return the first curves of chosen shapes with a pattern, with the paint that has it, and it."""
    curves = session.document.curves
    return [
        (place, *painted)
        for place in sorted(whole_shapes(session.document, session.selected.marked))
        for painted in _tiles(curves[place].style)
        if shape_of(session.document, place).start == place
    ]


class PatternCommands:
    """Object to Pattern, and Pattern to Objects."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

    @action(
        "objectToPattern",
        "Object to Pattern",
        CURVE_PATTERNS,
        "Alt+I",
        "paint-pattern",
        full_name="Objects to Pattern",
        needs=HIGHLIGHTED,
        keywords="tile repeat fill texture",
    )
    def _make(self) -> None:
        """Put a rectangle in the place of what is chosen, with that as its pattern."""
        session, before = self._session, self._session.document
        places = whole_shapes(before, session.selected.marked)
        page = before.page
        strokes = Strokes(side=max(page.width, page.height) if page is not None else 0.0)
        bounds = bounds_of(session.views, whole_curves(before, places), strokes)
        if bounds is None or not (bounds.size[0] > 0 and bounds.size[1] > 0):
            session.refuse("A pattern needs a width and a height.")
            return
        try:
            pattern = _pattern_of(before, places, bounds)
        except ExchangeError as problem:
            session.refuse(str(problem))
            return
        at, groups = max(places), before.curves[max(places)].groups
        frame = Rectangle(*bounds.low, *bounds.size)
        style = Style(stroke=NO_PAINT).with_gradient("fill", pattern)
        curve = replace(formed_anew(make_curve((), name="Pattern"), frame), style=style, groups=groups)

        def edit(document: Document) -> Document:
            return remove_curves(add_curves(document, [curve], at + 1, Container(groups=groups)), places)

        place = at + 1 - len(places)
        if session.change(f"{named(before, places)} to pattern", edit, active=place):
            session.selected.choose((place,))
            session.say("The rectangle is filled with what was chosen; the Gradient tool has its marks.")

    @action(
        "patternToObjects",
        "Pattern to Objects",
        CURVE_PATTERNS,
        needs=Need("a shape with a pattern", _has_pattern),
        keywords="tile extract take apart",
    )
    def _take_apart(self) -> None:
        """Take what a pattern repeats out of it, as objects where its first tile lies."""
        session, document = self._session, self._session.document
        place, paint, pattern = _patterned(session)[0]
        shape = shape_of(document, place)
        try:
            found = exchange.svg.tile_documents.document_of(pattern).curves
        except ExchangeError as problem:
            session.refuse(str(problem))
            return
        around = Container(groups=document.curves[place].groups)
        own = (*around.groups, free_group_name(document, "Pattern")) if len(found) > 1 else around.groups
        curves = [replace(each, groups=(*own, *each.groups)) for each in found]
        at = shape.stop

        def edit(document: Document) -> Document:
            return add_curves(with_style(document, shape, **{paint: NO_PAINT}), curves, at, around)

        if session.change(f"Pattern of {named(document, shape)} to objects", edit, active=at):
            session.selected.choose(range(at, at + len(curves)))
            session.say(f"{count_of(len(curves), 'object')} taken out of the pattern, and chosen.")


def _pattern_of(document: Document, places: frozenset[int], bounds: Bounds) -> Gradient:
    """Return some curves as a pattern whose first tile lies where they are."""
    curves = tuple(document.curves[place] for place in sorted(places))
    page = Page(*bounds.low, *bounds.size)
    tile = exchange.svg.tile_documents.tile_of(replace(document, curves=curves, page=page))
    colour = next(iter(colours_of(curves)), _BLACK)
    (left, low), (right, top) = bounds.low, bounds.high
    return Gradient(
        colouring(colour), GradientKind.PATTERN, (left, top), (right, top), (left, low), tile=tile
    )
