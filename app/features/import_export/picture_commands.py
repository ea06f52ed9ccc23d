"""Pictures in files: placed in a drawing, as objects."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ... import exchange
from ...document.contents import corners_of
from ...document.edits import EditError
from ...document.layers import free_layer
from ...document.model import Curve, Document, Vector
from ...document.words import count_of
from ...session.brought import choose_brought
from ...storage.files import StorageError, read
from ...view_model.pieces.arrivals import Target
from ...workbench.context import WindowContext
from ...workbench.placed_pictures import picture_curve


class PictureCommands:
    """Puts pictures in front in the layer that is drawn in."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        context.files.place = self.place

    def place(self, paths: Sequence[Path], at: Vector | None) -> str:
        """Place pictures with their middles at a place, or in the middle of the page that is in sight.

        Returns
        -------
        str
            Why others were not placed, in sentences.
        """
        canvas, session = self._context.central.canvas, self._session
        layer, pixel = free_layer(session.committed, session.selected.layer), canvas.camera.pixel_size
        document, placed, problems = session.committed, list[Path](), list[str]()
        places = range(0)
        for path in paths:
            try:
                curve = picture_curve(read(path), path.stem, f"“{path.name}”", document)
            except (StorageError, EditError) as problem:
                problems.append(f"{path.name} was not imported. {problem}")
                continue
            middle = self._middle_for(curve, document) if at is None else at
            arrival = Target(document, middle, pixel, layer).filled([curve])
            document, placed = arrival.document, [*placed, path]
            # Each is in front of the one before.
            places = range(arrival.places.stop - len(placed), arrival.places.stop)
        if placed:
            self._context.preferences.last_folder = placed[-1].parent
            self._bring(document, places, placed)
        return " ".join(problems)

    def _bring(self, document: Document, places: range, paths: Sequence[Path]) -> None:
        """Make a step of a document with pictures, and choose these."""
        session, canvas = self._session, self._context.central.canvas
        what = paths[0].name if len(paths) == 1 else count_of(len(paths), "picture")
        if not session.change(f"Import {what}", lambda _: document, active=places.start):
            return
        choose_brought(session.selected, places)
        if not canvas.framing.shows_curves(places):
            self._context.actions["fitView"].trigger()
        if len(paths) > 1:
            session.say(f"Imported {what}; they are chosen.")
        else:
            size = exchange.units.size_in_words(*_size_of(document.curves[places.start]), document.unit)
            session.say(f"Imported {what}, {size.rstrip()}; it is chosen.")

    def _middle_for(self, frame: Curve, document: Document) -> Vector:
        """Return where the middle of a picture goes: to that of what is in sight of the page, and onto it."""
        x_min, y_min, x_max, y_max = self._context.central.canvas.pixel_map.box
        page = document.page
        assert page is not None
        width, height = _size_of(frame)
        return (
            _onto(width, (page.x, page.x + page.width), (x_min, x_max)),
            _onto(height, (page.y, page.y + page.height), (y_min, y_max)),
        )


def _size_of(frame: Curve) -> Vector:
    """Return width and height of a picture that has not been turned."""
    (left, top), _, (right, bottom), _ = corners_of(frame)
    return right - left, top - bottom


def _onto(length: float, page: tuple[float, float], seen: tuple[float, float]) -> float:
    """Return the middle of what is so long and lies on a page, in the middle of that part which is seen."""
    low, high = max(page[0], seen[0]), min(page[1], seen[1])
    middle = (low + high) / 2 if low < high else sum(page) / 2
    room = length / 2
    return min(max(middle, page[0] + room), page[1] - room)
