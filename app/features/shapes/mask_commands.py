"""Shapes seen through the light of another one, and whole again."""

from __future__ import annotations

from msgspec.structs import replace

from ... import exchange
from ...actions.declaration import action, also
from ...actions.needs import Need
from ...actions.sections import CURVE_CLIPS
from ...actions.situation import Situation
from ...actions.strips import CHOSEN_MENU
from ...document.mask import Mask
from ...document.mask_edits import masked_among, with_mask_set, with_masks_released
from ...document.model import Document, Page
from ...document.several_curves import whole_curves
from ...exchange.errors import ExchangeError
from ...session import Session
from ...view_model.boxes.bounds import Strokes, bounds_of
from ...view_model.shapes.regions import named_operands, operands
from ...workbench.context import WindowContext
from .chosen_shapes import SEVERAL_SHAPES, meant

_BEYOND = 0.1
"""Share of the longer side of a mask that is seen around it: letters and blurs reach beyond their boxes."""


def _is_masked(now: Situation) -> bool:
    return bool(masked_among(now.session.document, meant(now.session)))


class MaskCommands:
    """Masks of the chosen shapes."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

    @action(
        "setMask",
        "Set Mask",
        CURVE_CLIPS,
        icon="mask",
        full_name="Set Mask of Shapes",
        needs=SEVERAL_SHAPES,
        keywords="masking luminance fade transparency opacity hide object",
    )
    @also(CHOSEN_MENU(33))
    def _set(self) -> None:
        """Show the chosen objects where the one in front is light, and not where it is black or clear."""
        session, document = self._session, self._session.document
        *others, front = operands(document, meant(session))
        if not others:
            session.refuse("Choose two shapes or more: the one in front masks the others.")
            return
        try:
            mask = _mask_of(session, frozenset(front.places))
        except ExchangeError as problem:
            session.refuse(str(problem))
            return
        what = f"Set mask of {named_operands(document, meant(session))}"
        masked = frozenset(place for each in others for place in each.places)

        def edit(document: Document) -> Document:
            return with_mask_set(document, masked, front.places, mask)

        if session.change(what, edit, active=min(masked)):
            session.selected.choose(masked)
            session.say(f"{what}: what is light in it is seen; Release Mask brings it back.")

    @action(
        "releaseMask",
        "Release Mask",
        CURVE_CLIPS,
        icon="release-mask",
        full_name="Release Mask of Shapes",
        needs=Need("a shape that is masked", _is_masked),
        keywords="unmask remove whole luminance",
    )
    @also(CHOSEN_MENU(33))
    def _release(self) -> None:
        """Show the chosen shapes whole, and what masked them as objects of their own."""
        session, document = self._session, self._session.document
        masked = masked_among(document, meant(session))
        masks = dict.fromkeys(mask for place in sorted(masked) for mask in document.curves[place].style.masks)
        try:
            objects = [exchange.svg.tile_documents.objects_of(mask).curves for mask in masks]
        except ExchangeError as problem:
            session.refuse(str(problem))
            return
        what = f"Release mask of {named_operands(document, masked)}"
        _, places = with_masks_released(document, masked, objects)
        if session.change(what, lambda now: with_masks_released(now, masked, objects)[0], active=min(masked)):
            session.selected.choose(masked | places)
            session.say(f"{what}: what masked it is chosen, too.")


def _mask_of(session: Session, places: frozenset[int]) -> Mask:
    """Return some curves as a mask that lies where they are.

    Raises
    ------
    ExchangeError
        If there is nothing to be drawn of them.
    """
    document, page = session.document, session.document.page
    strokes = Strokes(side=max(page.width, page.height) if page is not None else 0.0)
    bounds = bounds_of(session.views, whole_curves(document, places), strokes)
    side = max(bounds.size) if bounds is not None else 0.0
    if bounds is None or not side > 0:
        raise ExchangeError("A mask needs a width or a height.")
    curves = [document.curves[place] for place in sorted(places)]
    beyond = _BEYOND * side + 3 * max(curve.style.blur for curve in curves)
    (left, low), (right, top) = bounds.low, bounds.high
    left, low, right, top = left - beyond, low - beyond, right + beyond, top + beyond
    alone = replace(
        document,
        # On a page of another size a line without a width would have another one.
        curves=tuple(replace(curve, style=strokes.printed(curve.style)) for curve in curves),
        page=Page(left, low, right - left, top - low),
    )
    tile = exchange.svg.tile_documents.tile_of(alone)
    return Mask(tile, (left, top), (right, top), (left, low))
