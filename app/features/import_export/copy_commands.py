"""Pictures on the clipboard: the chosen curves, or else the whole drawing."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QMimeData
from PySide6.QtGui import QImage

from ... import exchange
from ...actions.declaration import action
from ...actions.menus import EDIT_COPY_AS
from ...actions.needs import Need
from ...document.model import Document
from ...document.several_curves import alone, named
from ...exchange.formats import Written
from ...tasks.progress import Report, part
from ...workbench.clipboard import SVG, put_on_clipboard
from ...workbench.context import WindowContext

_WIDTH = 1600

_ANY_CURVE = Need(
    "a curve through two points or more", lambda state: state.has_curve or state.curve_count > 1
)


class CopyCommands:
    """Copies as SVG, as a picture and as path data."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session

    @action("copySvg", "Copy as SVG", EDIT_COPY_AS, needs=_ANY_CURVE, keywords="inkscape, figma, markup")
    def _copy_svg(self) -> None:
        """Copy the chosen curves, or else all, as SVG: for drawing programs, and as text."""

        def put(written: Written, what: str) -> None:
            data = QMimeData()
            data.setData(SVG, written.data)
            data.setText(written.text)
            put_on_clipboard(data)
            self._session.say(f"Copied {what} as SVG.")
            self._context.work.warn_of(written.remarks)

        def work(document: Document, report: Report) -> Written:
            return exchange.svg_for_clipboard(document, report)

        self._start("Writing SVG", "The SVG", work, put)

    @action("copyImage", "Copy as Image", EDIT_COPY_AS, "Ctrl+Shift+C", needs=_ANY_CURVE)
    def _copy_image(self) -> None:
        """Copy the chosen curves, or else all, as a picture without background, PNG and SVG."""

        def put(pictures: tuple[bytes, bytes], what: str) -> None:
            png, svg = pictures
            data = QMimeData()
            data.setData("image/png", png)
            data.setData(SVG, svg)
            data.setImageData(QImage.fromData(png))
            put_on_clipboard(data)
            self._session.say(f"Copied {what} as an image: PNG without background, and SVG.")

        def work(document: Document, report: Report) -> tuple[bytes, bytes]:
            options = exchange.options.Options(width=_WIDTH, transparent=True, report=part(report, 0.0, 0.5))
            png = exchange.png_file(document, options).data
            svg = exchange.svg_for_clipboard(document, part(report, 0.5, 1.0))
            return png, svg.data

        self._start("Drawing", "The image", work, put)

    @action("copyPathData", "Copy as SVG Path", EDIT_COPY_AS, needs=_ANY_CURVE)
    def _copy_path_data(self) -> None:
        """Copy the chosen curves, or else all, as the path data of an SVG."""

        def put(written: Written, what: str) -> None:
            data = QMimeData()
            data.setText(written.text)
            put_on_clipboard(data)
            self._session.say(f"Copied {what} as SVG path data.")
            self._context.work.warn_of(written.remarks)

        def work(document: Document, report: Report) -> Written:
            return exchange.svg_path_data(document, exchange.options.Options(report=report))

        self._start("Writing path data", "The path data", work, put)

    def _start(
        self,
        title: str,
        name: str,
        work: Callable[[Document, Report], Any],
        put: Callable[[Any, str], None],
    ) -> None:
        """Do work for what is copied, beside the window, and put the result on the clipboard."""
        document, chosen = self._session.document, self._session.selected.chosen
        what = "the drawing"
        if chosen:
            document, what = alone(document, chosen), named(document, chosen)
        self._context.work.start(
            title, lambda report: work(document, report), lambda made: put(made, what), Path(name), "copied"
        )
