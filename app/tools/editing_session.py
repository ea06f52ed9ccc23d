"""The session as the tools see it: document, selection and messages. Protocols, so that tools need no Qt."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Sequence
from typing import Protocol

from ..document.fields import NO_SCROLL, Scroll
from ..document.model import Curve, Document, Vector
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
        """The curves that are selected as wholes."""

    @property
    def target_curves(self) -> frozenset[int]:
        """Target of actions on curves."""

    @property
    def state(self) -> SelectionState:
        """The present selection."""

    def restore(self, state: SelectionState) -> None:
        """Restore a selection."""

    def select_whole(self, indices: Collection[int]) -> None:
        """Select curves as wholes, or none at all; no curve is edited any more."""

    def show_whole(self, indices: Collection[int]) -> None:
        """Show curves as selected during a gesture."""

    def set_points(self, indices: Collection[int]) -> None:
        """Select points of the active curve alone."""

    def set_group(self, group: PointGroup) -> None:
        """Select points of the curves that are edited."""

    def show_group(self, group: PointGroup) -> None:
        """Show points as selected during a gesture."""

    def switch_active(self, index: int) -> None:
        """Make another of the edited curves the active one; the same points stay selected."""

    def set_curves(self, indices: Collection[int]) -> None:
        """Select curves to work on together."""

    def set_hovered(self, index: int) -> None:
        """Set the point under the pointer."""

    def activate(self, index: int) -> None:
        """Edit another curve."""

    def edit_active(self) -> None:
        """Edit the active curve, because the tool needs one."""

    def edit_selected(self) -> None:
        """Edit the selected whole curves."""


class EditingBox(Protocol):
    """Box around the selection of a session, as the tools use it."""

    pivot: Pivot | None
    turns: bool

    def set_pivot(self, pivot: Pivot | None) -> None:
        """Rotate, scale and mirror about another position; None for the middle."""

    def set_turns(self, turns: bool) -> None:
        """Use grips that rotate and skew, or grips that scale."""


class EditingScrub(Protocol):
    """Scrub line of a session, as the tools use it."""

    t: float | None

    def set(self, t: float | None) -> None:
        """Move the line, or hide it (None)."""


class EditingSession(Protocol):
    """Document, selection and messages of a session, as the tools use them."""

    active_index: int

    @property
    def selected(self) -> EditingSelection:
        """The selection."""

    @property
    def box(self) -> EditingBox:
        """The pivot and the grips of the box around the selection."""

    @property
    def scrub(self) -> EditingScrub:
        """The scrub line."""

    @property
    def document(self) -> Document:
        """The current document."""

    @property
    def is_previewing(self) -> bool:
        """Whether a gesture in flight previews another document."""

    @property
    def views(self) -> list[CurveView]:
        """The views of all curves."""

    @property
    def active_view(self) -> CurveView:
        """The view of the active curve."""

    @property
    def template_curve(self) -> Curve:
        """The curve that gives a new one its family, rules and style."""

    def report(self, done: str, before: Sequence[Curve], exempt: Collection[Vector] = ()) -> None:
        """Report the last step in words, and name points that it has set to keep the shape.

        `before` are the curves before it, `exempt` the positions of its own points.
        """

    def preview(
        self, document: Document, *, active: int | None = None, selects: SelectionState | None = None
    ) -> bool:
        """Show a document for the length of the gesture, with another selection if one is given.

        Return whether it is shown; it is not where that curve is locked.
        """

    def commit(
        self, document: Document, text: str, *, active: int | None = None, scroll: Scroll = NO_SCROLL
    ) -> object:
        """End the gesture with a document as a step of the history; true where it is one.

        Undo and redo of it return to the parts of the plane that were visible before and after a `scroll`.
        """

    def change(
        self,
        text: str,
        edit: Callable[[Document], Document],
        *,
        active: int | None = None,
        run: Hashable = None,
        scroll: Scroll = NO_SCROLL,
    ) -> object:
        """Make the document that `edit` returns a step of the history; true where it is one.

        Quick changes of the same run are one step; `active` is another curve to edit from then on.
        """

    def cancel(self) -> None:
        """Drop the preview, and restore the selection before it."""

    def interrupt(self) -> object:
        """Drop the gesture in flight with its preview."""

    def say(self, text: str, *, is_hint: bool = False) -> None:
        """Show a sentence in the status line; a hint about the next press goes with the tool in use."""

    def refuse(self, text: str) -> None:
        """Say why something was not done."""
