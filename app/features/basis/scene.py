"""Scene of the basis panel: every basis function over t, the t-rail at its foot, and the scrub line."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject, Signal

from ...plotting.camera import GREATEST_SPAN, CameraOverT
from ...plotting.tool_plot import ToolPlot
from ...view_model.basis import BasisView, CardinalView, basis_view, cardinal_view
from ...view_model.curve.curve_view import CurveView
from .layers import FunctionLayer, RailLayer, rail_height

_CALM_RANGE = (-0.5, 1.2)
_MOST_ROOM = 0.2  # for numbers above the functions, of the height that these have
_PADDING = 0.035
_WHAT = "The basis functions"


class BasisScene(QObject):
    """The layers of the basis panel, and the ranges that show them.

    Attributes
    ----------
    functions, rail
        All basis functions of the curve that is edited; the t-rail with the scrub line.
    basis
        The functions on screen, None without a curve.
    with_estimates
        Whether they say what each point does with the estimates that follow it.

    Signals
    -------
    extent_changed
        (least, greatest) value of the functions if they leave the visible range, else None.
    """

    extent_changed = Signal(object)

    def __init__(self, plot: ToolPlot, camera: CameraOverT) -> None:
        super().__init__(plot)
        self._plot, self._camera = plot, camera
        self._box = plot.getViewBox()
        self._view: CurveView | None = None
        self.basis: BasisView | None = None
        self._values: tuple[float, float] = _CALM_RANGE
        self._held_domain: tuple[float, float] | None = None
        self.functions = FunctionLayer(plot)
        self.rail = RailLayer(plot)
        self._box.sigResized.connect(self.show_values)
        self.set_with_estimates(False)

    def render_view(self, view: CurveView) -> None:
        """Show the functions of `view`; they are sampled again only if they are other ones."""
        self._view = view
        shows_cardinals = self.with_estimates and view.source.family.derivatives > 0
        if _is_of(self.basis, view, shows_cardinals):
            return
        before = self._domain_of_ticks()
        self.basis = cardinal_view(view) if shows_cardinals else basis_view(view, self.basis)
        self.functions.render(self.basis)
        self.rail.render(view)
        domain = self._domain_of_ticks()
        moved = domain is not None and domain != before
        was_held = self._held_domain is not None and self._domain() == self._held_domain
        if (moved or not view.source.points) and not self._plot.is_dragging and not was_held:
            self.fit_domain()
        self._report_extent()

    def set_with_estimates(self, shown: bool) -> None:
        """Show cardinal functions, which contain estimates, or the family's own from the next view on."""
        self.with_estimates = shown
        name, what = ("Cardinal functions", "What each point does") if shown else ("Basis functions", _WHAT)
        self._plot.setAccessibleName(name)
        self._plot.setAccessibleDescription(f"{what} over t; drag a tick at the foot to change t.")

    def set_selection(self, selection: frozenset[int]) -> None:
        """Draw the functions of these points thick."""
        if selection != self.rail.selection:
            self.rail.selection = selection
            self._emphasise()

    def set_hovered(self, index: int) -> None:
        """Draw the functions of this point thick, too (−1 for none)."""
        if index != self.rail.hovered:
            self.rail.hovered = index
            self._emphasise()

    def _emphasise(self) -> None:
        hovered = self.rail.hovered
        self.functions.emphasised = self.rail.selection | ({hovered} if hovered >= 0 else frozenset())
        self.functions.update()
        self.rail.update()

    def set_scrub(self, t: float | None) -> None:
        """Move the scrub line, or put it away (None)."""
        self.rail.scrub = t
        self.rail.update()

    def switch_kind(self, kind: int) -> None:
        """Show a kind of functions, or hide it: 0 of positions, else those of derivatives of that order."""
        self.functions.kinds ^= {kind}
        self.functions.update()
        self._report_extent()

    # Ranges

    def fit_domain(self) -> None:
        """Show the whole interval of t."""
        domain = self._domain()
        if domain is not None:
            start, end = domain
            padding = _PADDING * (end - start)
            self._camera.show_t(start - padding, end + padding)

    def hold_domain(self) -> None:
        """Keep the interval in view as it is while a drag changes it: ticks must not run from the pointer."""
        self._held_domain = self._domain()

    def release_domain(self) -> None:
        """Show the whole interval if the drag that ends has changed it."""
        held, self._held_domain = self._held_domain, None
        if held is not None and self._domain() != held:
            self.fit_domain()

    def _domain(self) -> tuple[float, float] | None:
        """Return the interval of t; without points that which the rule is going to span, else None."""
        domain = self._domain_of_ticks()
        if domain is not None or self._view is None or self._view.source.points:
            return domain
        rule = self._view.source.parametrization
        return rule.start, rule.end

    def _domain_of_ticks(self) -> tuple[float, float] | None:
        ticks = self.rail.parameters
        return (float(ticks[0]), float(ticks[-1])) if len(ticks) else None

    def fit_values(self) -> None:
        """Show the functions from their least to their greatest value, as far as an axis reaches."""
        if self.basis is not None:
            low, high = self.basis.extent(self.functions.kinds)
            most = 0.5 * GREATEST_SPAN / (1.0 + self._rail_share())
            low, high = max(low, -most), min(high, most)
            margin = 0.05 * (high - low)
            low, high = min(low - margin, _CALM_RANGE[0]), max(high + margin, _CALM_RANGE[1])
            self._values = (max(low, -most), min(high, most))
            self.show_values()

    def calm_values(self) -> None:
        """Show the usual range again, −0.5 to 1.2."""
        self._values = _CALM_RANGE
        self.show_values()

    def show_values(self) -> None:
        """Map the range of values to the part of the plot area above the rail."""
        low, high = self._values
        if self._values == _CALM_RANGE:
            # The functions of points are 1 at their crests: their numbers have room above, in any font.
            room = min(self.functions.room_above() / self._height_above_rail(), _MOST_ROOM)
            high = max(high, (1.0 - room * low) / (1.0 - room))
        self._plot.getAxis("left").set_least(low)
        self._box.setYRange(low - self._rail_share() * (high - low), high, padding=0)
        self._report_extent()

    def _rail_share(self) -> float:
        """Return the height of the rail as a share of what is left for the functions."""
        return rail_height(self.rail.scale) / self._height_above_rail()

    def _height_above_rail(self) -> float:
        return max(float(self._box.rect().height()) - rail_height(self.rail.scale), 1.0)

    def _report_extent(self) -> None:
        extent = self.basis.extent(self.functions.kinds) if self.basis is not None else None
        low, high = self._values
        inside = extent is None or (extent[0] >= low and extent[1] <= high)
        self.extent_changed.emit(None if inside else extent)


def _is_of(basis: BasisView | None, view: CurveView, cardinals: bool) -> bool:
    """Tell whether these are the functions of `view`.

    Those of a family depend on it, its settings and the parameters alone; cardinal ones on the rules, too.
    """
    if basis is None:
        return False
    if view.displacement is not None and not cardinals and basis.curve is view.displacement.moving.curve:
        # As under most drags: points move, and the functions rest.
        return not isinstance(basis, CardinalView)
    if not view.is_current or len(view.source.points) <= basis.owners[-1]:
        return False
    if cardinals or isinstance(basis, CardinalView):
        return cardinals and isinstance(basis, CardinalView) and basis.cardinal is view.cardinal
    functions = view.basis_curve
    if basis.curve is functions:
        return True
    same_family = functions is not None and basis.curve.functions_key == functions.functions_key
    closes = (basis.owners[-1] == 0) is view.source.is_closed
    return same_family and closes and np.array_equal(view.parameters, basis.curve.parameters)
