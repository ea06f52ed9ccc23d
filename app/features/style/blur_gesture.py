"""The blur of what is chosen, changed live by a slider."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ...document.model import Document
from ...document.several_curves import named
from ...document.shapes import shape_of
from ...document.style import Style
from ...document.style_edits import with_style
from ...session import Session
from ...view_model.boxes.shape_boxes import box_of_shape
from ...workbench.slider_gesture import SliderGesture
from .blur_field import BlurField, blur_at


class BlurGesture:
    """Blurs curves by a slider, which goes by the size of the largest of them.

    Parameters
    ----------
    curves
        Returns the places of what is chosen.
    """

    def __init__(self, session: Session, field: BlurField, curves: Callable[[], frozenset[int]]) -> None:
        self._session, self._field, self._curves = session, field, curves
        self._gesture = SliderGesture(session, field.slider, self._blurred, self._words)

    def render(self, styles: Sequence[Style], *, is_sharp: bool) -> None:
        """Show how blurred styles are; `is_sharp` of what is drawn next."""
        blurs = {0.0} if is_sharp else {style.blur for style in styles}
        self._field.setEnabled(not is_sharp)
        # Boxes of thousands take their time, and what is sharp needs none.
        size = self.size if any(blurs) else 0.0
        self._field.render_value(blurs.pop() if len(blurs) == 1 else None, self._session.document.unit, size)

    @property
    def size(self) -> float:
        """A quarter of width and height of the largest shape that is chosen: the most that it is blurred."""
        session = self._session
        starts = {shape_of(session.document, curve).start for curve in self._curves()}
        boxes = (box_of_shape(session.views, shape_of(session.document, start)) for start in starts)
        return max(((x - left + y - low) / 4 for (left, low), (x, y) in boxes), default=0.0)

    def _blurred(self, document: Document, position: int) -> Document:
        return with_style(document, self._curves(), blur=blur_at(position, self.size))

    def _words(self, _position: int) -> str:
        return f"Blur of {named(self._session.committed, self._curves())}"
