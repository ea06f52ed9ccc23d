"""The page of the document: drawn, put around the curves, taken away."""

from __future__ import annotations

from ...actions.declaration import action
from ...actions.needs import CURVE_THROUGH_TWO, PAGE
from ...actions.sections import EDIT_PAGE
from ...document.model import Page
from ...document.plane_edits import set_page
from ...document.words import number
from ...exchange import drawing
from ...exchange.errors import ExchangeError
from ...workbench.context import WindowContext


class PageCommands:
    """Keeps the canvas in step with the page of the document, and changes it."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session
        self._layer = context.central.canvas.drawing.page
        self.show_document()

    def show_document(self) -> None:
        """Show the page of the document."""
        self._layer.render(self._session.document.page)

    @action(
        "pageAroundCurves",
        "Page Around the Curves",
        EDIT_PAGE,
        needs=CURVE_THROUGH_TWO,
        title=lambda now: f"Page Around the {now.things}",
        keywords="resize fit artboard canvas size drawing export area",
    )
    def _put_around(self) -> None:
        """Let pictures show just what the visible curves take, with their strokes, whatever comes later."""
        document = self._session.document
        try:
            frame = drawing.trim.frame_of(document)
        except ExchangeError as problem:
            self._session.refuse(str(problem))
            return
        page = Page(frame.left, frame.bottom, frame.width, frame.height)
        if self._session.change("Page Around the Curves", lambda document: set_page(document, page)):
            size = f"{number(page.width)} × {number(page.height)} {document.unit}".strip()
            self._session.say(f"The page is {size}; pictures show what lies on it.")

    @action("noPage", "No Page", EDIT_PAGE, needs=PAGE, keywords="remove delete artboard export area")
    def _take_away(self) -> None:
        """Let pictures show what the curves take, however they change."""
        self._session.change("No Page", lambda document: set_page(document, None))
        self._session.say("There is no page; pictures show all visible curves.")


COMMAND_SETS = (PageCommands,)
