"""The view box of a plot: it asks for its ranges when it gets another size."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..qt.overrides import Guarded
from .graphs import pg


class ViewBox(Guarded, pg.ViewBox):  # type: ignore[misc]  # pyqtgraph has no types
    """pyqtgraph's view box without its menu.

    Attributes
    ----------
    resized
        Called when it has another size, before it suits its ranges to that: what is set here is all that
        anybody hears of.
    """

    resized: Callable[[], object] | None = None

    def __init__(self) -> None:
        super().__init__(enableMenu=False)

    def resizeEvent(self, event: Any) -> None:  # noqa: ANN401 - an event without a class of its own in Python
        if self.resized is not None and event.oldSize() != event.newSize():
            self.resized()
        super().resizeEvent(event)
