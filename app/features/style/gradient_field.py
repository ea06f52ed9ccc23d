"""Fields of a paint beside its colour: its kind, the stops of a gradient, which pattern it is."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msgspec.structs import replace
from PySide6.QtCore import Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QWidget

from ...document.gradient import Spread, Stop, Tile, with_stop_at
from ...document.gradient_edits import PaintKind, gradient_of, paint_kind
from ...document.style import Style
from ...widgets.boxes import column_of, row_of
from ...widgets.choice_row import ChoiceRow
from ...widgets.percent_field import PercentField
from ...widgets.tool_buttons import action_button, tool_button
from .pattern_row import PatternRow
from .stop_bar import StopBar

_ICONS = ("paint-none", "paint-flat", "paint-linear", "paint-radial", "paint-pattern")
"""Of the kinds of paint."""


class GradientField(QWidget):
    """Shows a paint of several styles, "fill" or "stroke", and asks for others.

    Its fields are about one stop, the chosen one; the colour of it is chosen elsewhere. A button has the
    `tool` that drags gradients on the canvas.

    Signals
    -------
    kind_chosen
        Another kind of paint.
    stops_wanted, stops_looked_at, given_up
        Other stops are wanted, or looked at, or no more.
    spread_chosen
        What lies beyond the stops.
    tile_chosen
        Another pattern.
    picked
        Another stop shall be chosen.

    Attributes
    ----------
    bar, patterns
        The stops, and the patterns.
    opacity
        The field of the opacity of the chosen stop.
    offset
        The field of its place.
    is_mixed
        Whether one is a gradient and another is not, or they have different stops: no colour is theirs.
    """

    kind_chosen = Signal(object)
    stops_wanted = Signal(object)
    stops_looked_at = Signal(object)
    given_up = Signal()
    spread_chosen = Signal(object)
    tile_chosen = Signal(object)
    picked = Signal(int)

    def __init__(self, paint: str, label: str, tool: QAction, colour: QWidget) -> None:
        super().__init__()
        self._paint, self._chosen = paint, 0
        self._stops: tuple[Stop, ...] = ()
        self.is_mixed = False
        self._kind = ChoiceRow(f"{paint}Kind", label, f"{label}, kind of paint", PaintKind, _ICONS)
        self._tiles: tuple[Tile, ...] = ()
        self.patterns = PatternRow(paint, label)
        self.bar = StopBar(f"{paint}Stops", label)
        self.offset = PercentField(f"{paint}StopOffset", f"{label}, place of the stop", "Where the stop lies")
        self.opacity = PercentField(
            f"{paint}StopOpacity", f"{label}, opacity of the stop", "How much of the stop is seen"
        )
        self._spread = ChoiceRow(
            f"{paint}Spread", f"{label}, beyond", "What lies beyond the first and the last stop", Spread
        )
        self._reverse = tool_button(
            f"{paint}StopsReverse", f"{label}, reverse the gradient", "Reverse the stops", text="⇄"
        )
        on_canvas = action_button(tool, name=f"{paint}GradientTool")
        self._gradient = QWidget()
        column_of(
            row_of((self.bar, 1), self._reverse, on_canvas, margins=0, spacing=4),
            row_of("at", (self.offset, 1), margins=0, spacing=6),
            row_of("seen", (self.opacity, 1), margins=0, spacing=6),
            self._spread,
            margins=0,
            spacing=4,
            parent=self._gradient,
        )
        # The colour stands above the stops: it stays under the pointer when they come and go.
        column_of(self._kind, colour, self.patterns, self._gradient, margins=0, spacing=4, parent=self)

    def connect_fields(self) -> None:
        """Tell what is wanted; whoever has to watch the fields does so before."""
        self._kind.chosen.connect(self.kind_chosen)
        self._spread.chosen.connect(self.spread_chosen)
        self.patterns.chosen.connect(self.tile_chosen)
        self._reverse.clicked.connect(self._turn_round)
        self.bar.picked.connect(self.picked)
        self.bar.looked_at.connect(self.stops_looked_at)
        self.bar.given_up.connect(self.given_up)
        self.bar.wanted.connect(self._want)
        self.offset.edit.entered.connect(lambda share: self.stops_wanted.emit(self.moved_to(share)))
        self.offset.edit.stepped.connect(lambda share: self.stops_wanted.emit(self.moved_to(share)))
        self.opacity.edit.entered.connect(lambda share: self.stops_wanted.emit(self.seen_as(opacity=share)))
        self.opacity.edit.stepped.connect(lambda share: self.stops_wanted.emit(self.seen_as(opacity=share)))

    # What is shown

    @property
    def stop(self) -> Stop | None:
        """The chosen stop; None where there is no gradient, or where they have different stops."""
        return self._stops[self._chosen] if self._stops else None

    def render_styles(self, styles: Sequence[Style], chosen: int) -> None:
        """Show the paint that styles have in common; of a gradient `chosen` is the stop that is chosen."""
        kinds = {paint_kind(style, self._paint) for style in styles}
        self._kind.render_value(kinds.pop() if len(kinds) == 1 else None)
        self.setEnabled(bool(styles))
        gradients = [gradient_of(style, self._paint) for style in styles]
        stops = {None if gradient is None else gradient.stops for gradient in gradients}
        self.is_mixed = len(stops) > 1
        self._stops = (stops.pop() or ()) if len(stops) == 1 else ()
        spreads = {gradient.spread for gradient in gradients if gradient is not None}
        self._spread.render_value(spreads.pop() if len(spreads) == 1 else None)
        tiles = {None if gradient is None else gradient.tile for gradient in gradients}
        are_patterns = bool(tiles) and None not in tiles
        self.patterns.setVisible(are_patterns)
        self._gradient.setVisible(bool(self._stops) and not are_patterns)
        if are_patterns:
            colour = self._stops[0].colour if self._stops else ""
            self.patterns.render_pattern(tiles.pop() if len(tiles) == 1 else None, colour, self._tiles)
        if self._stops:
            self._render_stop(min(chosen, len(self._stops) - 1))

    def show_tiles(self, tiles: Iterable[Tile]) -> None:
        """Offer these patterns, too, when there is one to be shown."""
        self._tiles = tuple(tiles)

    def _render_stop(self, chosen: int) -> None:
        self._chosen = chosen
        stop = self._stops[self._chosen]
        self.bar.render_stops(self._stops, self._chosen)
        self.offset.render_value(stop.offset)
        self.opacity.render_value(stop.opacity)

    # Other stops

    def seen_as(self, **fields: object) -> tuple[Stop, ...]:
        """Return the stops with other fields of the chosen one."""
        new = replace(self._stops[self._chosen], **fields)
        return (*self._stops[: self._chosen], new, *self._stops[self._chosen + 1 :])

    def moved_to(self, offset: float) -> tuple[Stop, ...]:
        """Return the stops with the chosen one elsewhere, between those beside it."""
        return with_stop_at(self._stops, self._chosen, offset)

    def _want(self, stops: tuple[Stop, ...], chosen: int) -> None:
        self.picked.emit(chosen)
        self.stops_wanted.emit(stops)

    def _turn_round(self) -> None:
        turned = (replace(stop, offset=1.0 - stop.offset) for stop in reversed(self._stops))
        self._want(tuple(turned), len(self._stops) - 1 - self._chosen)

    def abandon(self) -> None:
        """End a drag of a stop; what the mouse still does before its release means nothing."""
        self.bar.abandon()
