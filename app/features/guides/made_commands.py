"""Guides made of what is there: the edges of the page, boxes of objects, straight lines."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...actions.declaration import action, also
from ...actions.needs import CHOSEN, PAGE
from ...actions.sections import VIEW_GUIDES_MORE
from ...actions.strips import GUIDE_MENU
from ...document.curve_tree import whole_nodes
from ...document.gradient import Box
from ...document.guide import guide_at
from ...document.guide_edits import add_guides
from ...document.layers import begun_again
from ...document.model import Axis, Document, Guide
from ...document.several_curves import active_after_removal, named, remove_curves, whole_curves
from ...document.words import count_of
from ...view_model.boxes.bounds import UNCLIPPED, bounds_of
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.highlight import highlighted_curves

_STRAIGHT = 1e-9
"""Of a line's length, by which it may be off the straight way."""


class MadeGuideCommands:
    """Draws guides along what is there."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session

    @action(
        "guidesAroundPage",
        "Guides Around the Page",
        VIEW_GUIDES_MORE,
        needs=PAGE,
        keywords="create guides edges page border",
    )
    @also(GUIDE_MENU(22))
    def _around_page(self) -> None:
        """Draw a guide along each edge of the page."""
        page = self._session.document.page
        assert page is not None
        box = ((page.x, page.y), (page.x + page.width, page.y + page.height))
        self._context.store.change(guides_shown=True)
        self._session.change("Guides around the page", lambda document: add_guides(document, _edges(box)))

    @action(
        "objectsToGuides",
        "Objects to Guides",
        VIEW_GUIDES_MORE,
        needs=CHOSEN,
        keywords="convert selection guideline",
    )
    def _of_objects(self) -> None:
        """Put guides in the place of what is chosen: along straight lines, and around the box of all else."""
        session, before = self._session, self._session.document
        curves = highlighted_curves(self._context)
        guides, layer = list(self._along(curves)), session.selected.layer
        self._context.store.change(guides_shown=True)

        def edit(document: Document) -> Document:
            return begun_again(remove_curves(add_guides(document, guides), curves), document, layer)

        left = active_after_removal(before, curves, session.active_index, session.selected.edited)
        if session.change(f"{named(before, curves)} to guides", edit, active=left):
            added = len(session.document.guides) - len(before.guides)
            session.say(f"{count_of(added, 'guide')} drawn.")

    def _along(self, curves: frozenset[int]) -> Iterator[Guide]:
        document, views = self._session.document, self._session.views
        for node in whole_nodes(document.curves, curves, document.layers):
            straight = _line_of(views[node.places.start]) if len(node.places) == 1 else None
            bounds = bounds_of(views, whole_curves(document, node.places), UNCLIPPED)
            if straight is not None:
                yield straight
            elif bounds is not None:
                yield from _edges((bounds.low, bounds.high))


def _edges(box: Box) -> list[Guide]:
    """Return guides along the edges of a box."""
    return [Guide(axis, corner[axis.coordinate]) for axis in Axis for corner in box]


def _line_of(view: CurveView) -> Guide | None:
    """Return the guide along a straight line; None for any other curve."""
    ends = view.polyline[[0, -1]] if len(view.polyline) > 1 else None
    if ends is None or view.source.is_closed:
        return None
    across, up = map(float, ends[1] - ends[0])
    length = float(np.hypot(across, up))
    off = (view.polyline - ends[0]) @ np.array([-up, across])
    if not length or np.abs(off).max() > _STRAIGHT * length * length:
        return None
    return guide_at((float(ends[0][0]), float(ends[0][1])), float(np.degrees(np.arctan2(up, across))))
