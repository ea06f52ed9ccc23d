"""The curves of a document on the canvas, from the back to the front, whichever of them is edited."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import compress
from operator import is_not

from ..document.model import Vector
from ..document.shapes import shapes
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..tools.pointer import Hit
from ..view_model.curve.curve_view import CurveView
from .curve_layer import CurveLayer, EditedShapeLayer, is_faint
from .filled_areas import FilledAreas
from .line_finder import LineFinder
from .looks import Shape, is_plain
from .other_curves_layer import OtherCurvesLayer
from .selected_curves_layer import SelectedCurvesLayer, SiblingCurvesLayer

_ABOVE = -0.8
"""Height of what lies over the shape that is edited."""


class DrawnCurves:
    """Layers of all curves: what lies below the edited shape, that, what lies over it, and marks.

    A plain line that is edited is drawn over all others, as long as none of these is painted otherwise.

    Attributes
    ----------
    others, above
        The shapes that are not edited, below the edited one and over it; only the first finds curves.
    selected
        What marks the curves that are selected together with the edited one.
    siblings
        The points of the other curves of the shape that is edited.
    edited, curve
        The shape that is edited, in its style; the line of the active curve.
    areas
        The insides of what is filled.
    """

    def __init__(self, plot: PlotWidget) -> None:
        self.others = OtherCurvesLayer(plot)
        self.edited = EditedShapeLayer(plot)
        self.above = OtherCurvesLayer(plot, z=_ABOVE)
        self.selected = SelectedCurvesLayer(plot)
        self.siblings = SiblingCurvesLayer(plot)
        self.curve = CurveLayer(plot)
        self.areas = FilledAreas()
        self._locked = LineFinder()
        # The places of the curves of the edited shape, where it is no plain line.
        self._edited_places = range(0)
        self._shown: tuple[Sequence[CurveView], int | None, frozenset[int], frozenset[int]]
        self._shown = ((), 0, frozenset(), frozenset())

    def render(
        self,
        views: Sequence[CurveView],
        active: int | None,
        selected: frozenset[int],
        edited: frozenset[int],
    ) -> None:
        """Show the curves of a document: the active one if it is edited, those selected and those edited."""
        before, self._shown = self._shown, (views, active, selected, edited)
        self.areas.render(views)
        if not self._rest_since(*before):
            self._render_all()
        elif self._edited_places:
            self.edited.render(tuple(views[place] for place in self._edited_places))

    def follow(self, views: Sequence[CurveView]) -> None:
        """Show the same curves where they run now."""
        self.render(views, *self._shown[1:])

    def _rest_since(self, views: Sequence[CurveView], active: int | None, *places: frozenset[int]) -> bool:
        """Whether all that has changed is where the active curve runs, as under a drag."""
        now, *others = self._shown
        if active is None or others != [active, *places] or not active < len(now) == len(views):
            return False
        if list(compress(range(len(now)), map(is_not, now, views))) not in ([], [active]):
            return False
        new, old = now[active], views[active]
        return (
            new.source.style is old.source.style
            and new.source.visible is old.source.visible
            and new.source.shape == old.source.shape
            # Under a drag there is a curve in every frame.
            and ((new.motion is not None and old.motion is not None) or is_faint(new) is is_faint(old))
        )

    def _render_all(self) -> None:
        views, active, selected, edited = self._shown
        # Points are shown of what is edited, and of what is worked on together with it.
        self.selected.set_rings(active is not None)
        active = -1 if active is None else active
        other = [place for place in range(len(views)) if place != active]
        found = [
            (place, views[place])
            for place in other
            if place not in selected and views[place].source.visible and views[place].has_curve
        ]
        units = list(shapes([view.source for view in views]))
        below, shape, above = self._in_order(views, units, active, selected)
        self.others.render_shapes(below, found)
        seen = ((place, views[place]) for place in other if views[place].source.visible)
        self._locked.render([each for each in seen if each[1].source.locked and each[1].has_curve])
        self._edited_places = next(each for each in units if active in each) if shape else range(0)
        self.edited.render(shape)
        self.above.render_shapes(above, [])
        self.selected.render(views, [place for place in other if place in selected])
        siblings = [place for place in other if place in edited and place not in selected]
        self.siblings.render_shapes({place: (views[place],) for place in siblings}, [])
        self.curve.set_covered(bool(above))

    def _in_order(
        self, views: Sequence[CurveView], units: Sequence[range], active: int, selected: Collection[int]
    ) -> tuple[dict[int, Shape], Shape, dict[int, Shape]]:
        """Return the shapes below the edited one, that where it is no plain line, and those over it.

        Each stands at the place of its first curve. With no edited one, −1, all are below.
        """
        below: dict[int, Shape] = {}
        above: dict[int, Shape] = {}
        edited: Shape = ()
        is_layered, marked = False, {active, *selected}
        for places in units:
            is_line = is_plain(views[places.start])
            if active in places and not is_line and not is_faint(views[active]):
                edited, is_layered = tuple(views[place] for place in places), True
                continue
            # The edited one is a line of its own, plain or faint; what is selected is drawn by its marks.
            hidden = marked if is_line else (active,)
            shape = tuple(
                [
                    view
                    for place in places
                    if place not in hidden and (view := views[place]).source.visible and view.has_curve
                ]
            )
            if shape:
                is_over = places.start > active >= 0
                is_layered |= is_over and not is_line
                (above if is_over else below)[places.start] = shape
        return (below, edited, above) if is_layered else (below | above, edited, {})

    def hit(self, pixel: Vector, shown: PixelMap) -> Hit | None:
        """Return the curve at `pixel`, neither edited nor locked."""
        _, active, *_ = self._shown
        line = self.selected.hit(pixel, shown) or self.others.hit(pixel, shown)
        return self.areas.hit(pixel, shown, active, line)

    def locked_at(self, pixel: Vector, shown: PixelMap) -> int:
        """Return the place of the locked curve at `pixel`, which a press goes through; −1 for none."""
        hit = self._locked.hit(pixel, shown)
        return hit.index if hit is not None else -1

    def set_cased(self, cased: bool) -> None:
        """Keep plain lines apart from what lies below them, a picture to trace, or not."""
        for layer in (self.others, self.above, self.curve):
            layer.set_cased(cased)
