"""The session as the tools see it: document, selection and messages. Protocols, so that tools need no Qt."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable
from typing import Protocol

from ..document.model import Curve, Document
from ..document.point_group import PointGroup
from ..document.selection import SelectionState
from ..view_model.curve.curve_view import CurveView
from ..view_model.pivot import Pivot


class EditingSelection(Protocol):
    """Selection of a session, as the tools use it."""

    group: PointGroup
    curves: frozenset[int]
    is_editing: bool

    @property
    def points(self) -> frozenset[int]:
        """Indices of the selected points of the active curve."""

    @property
    def active_curves(self) -> frozenset[int]:
        """The curves whose points can be selected."""

    @property
    def whole_curves(self) -> frozenset[int]:
        """The curves that are acted on as wholes."""

    @property
    def state(self) -> SelectionState:
        """All that is selected now."""

    def restore(self, state: SelectionState) -> None:
        """Select what was selected before."""

    def select_whole(self, indices: Collection[int]) -> None:
        """Choose curves as wholes, or none at all; no curve is edited any more."""

    def show_whole(self, indices: Collection[int]) -> None:
        """Show curves as chosen while a gesture goes on."""

    def set_points(self, indices: Collection[int]) -> None:
        """Select points of the active curve alone."""

    def set_group(self, group: PointGroup) -> None:
        """Select points of the curves that are edited."""

    def show_group(self, group: PointGroup) -> None:
        """Show points as selected while a gesture goes on."""

    def switch_active(self, index: int) -> None:
        """Make another of the curves that are edited the active one; the same points are selected."""

    def set_curves(self, indices: Collection[int]) -> None:
        """Select curves to work on together."""

    def set_hovered(self, index: int) -> None:
        """Take note of the point under the pointer."""

    def activate(self, index: int) -> None:
        """Edit another curve."""

    def edit_active(self) -> None:
        """Edit the active curve, for a tool that needs one."""

    def edit_selected(self) -> None:
        """Edit what is chosen."""


class EditingBox(Protocol):
    """Box around what is selected in a session, as the tools use it."""

    pivot: Pivot | None
    turns: bool

    def set_pivot(self, pivot: Pivot | None) -> None:
        """Turn, scale and mirror about another place; None for the middle."""

    def set_turns(self, turns: bool) -> None:
        """Have grips that rotate and skew, or such that scale."""


class EditingScrub(Protocol):
    """Scrub line of a session, as the tools use it."""

    t: float | None

    def set(self, t: float | None) -> None:
        """Move the line, or put it away (None)."""


class EditingSession(Protocol):
    """Document, selection and messages of a session, as the tools use them."""

    active_index: int

    @property
    def selected(self) -> EditingSelection:
        """The selection."""

    @property
    def box(self) -> EditingBox:
        """What was chosen of the box around what is selected."""

    @property
    def scrub(self) -> EditingScrub:
        """The scrub line."""

    @property
    def document(self) -> Document:
        """The current document."""

    @property
    def is_previewing(self) -> bool:
        """Whether a gesture in flight shows another document."""

    @property
    def views(self) -> list[CurveView]:
        """The views of all curves."""

    @property
    def active_view(self) -> CurveView:
        """The view of the active curve."""

    @property
    def model(self) -> Curve:
        """The curve that what is drawn next is like."""

    def preview(
        self, document: Document, *, active: int | None = None, selects: SelectionState | None = None
    ) -> bool:
        """Show a document for the length of the gesture, with another selection if one is given.

        Return whether it is shown; it is not where that curve is locked.
        """

    def commit(self, document: Document, text: str, *, active: int | None = None) -> object:
        """End the gesture with this document as a step of the history; true where it is one."""

    def change(
        self,
        text: str,
        edit: Callable[[Document], Document],
        *,
        active: int | None = None,
        run: Hashable = None,
    ) -> object:
        """Make what `edit` returns a step of the history; true where it is one.

        Quick steps of the same run are one; `active` is the curve to edit from then on, where that changes.
        """

    def cancel(self) -> None:
        """Drop the preview, and select what was selected before it."""

    def say(self, text: str) -> None:
        """Show a sentence in the status line."""

    def refuse(self, text: str) -> None:
        """Say that something was not done, and why."""
