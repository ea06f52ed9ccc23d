"""Align and distribute selected points, or chosen curves."""

from __future__ import annotations

from typing import NamedTuple

from ...actions.declaration import Action, action_for_each, also_for_each
from ...actions.keymap import action_name
from ...actions.menus import (
    ALIGN_BUTTONS,
    ARRANGE_ALIGN_ACROSS,
    ARRANGE_ALIGN_TO,
    ARRANGE_ALIGN_UP,
    ARRANGE_DISTRIBUTE,
    MenuSection,
)
from ...actions.needs import Need
from ...actions.state import ActionState
from ...document.groups import expand_to_shapes
from ...document.model import Document
from ...document.several_curves import locked_remark, name_or_count, unlocked_curves
from ...document.transforms import Edge, Reference, Spacing, align_points, distribute_points
from ...session import Change, Session
from ...view_model.align import align_curves, distribute_curves
from ...workbench.context import WindowContext


class _Alignment(NamedTuple):
    """Alignment, and the words of its action."""

    edge: Edge
    section: MenuSection
    tip: str
    number: int


class _Distribution(NamedTuple):
    """Even spacing along x (axis 0) or y, and the words of its action."""

    axis: int
    spacing: Spacing
    direction: str
    tip: str
    number: int

    @property
    def what(self) -> str:
        """The word before the way: "Gaps " or none."""
        return "Gaps " if self.spacing is Spacing.GAPS else ""


_ALIGNMENTS = (
    _Alignment(Edge.LEFT, ARRANGE_ALIGN_ACROSS, "on the left edge", 10),
    _Alignment(Edge.CENTRE, ARRANGE_ALIGN_ACROSS, "on a vertical line through the centre", 11),
    _Alignment(Edge.RIGHT, ARRANGE_ALIGN_ACROSS, "on the right edge", 12),
    _Alignment(Edge.TOP, ARRANGE_ALIGN_UP, "on the top edge", 13),
    _Alignment(Edge.MIDDLE, ARRANGE_ALIGN_UP, "on a horizontal line through the middle", 14),
    _Alignment(Edge.BOTTOM, ARRANGE_ALIGN_UP, "on the bottom edge", 15),
)

_CENTRES = "Space the selected points, or the centres of the selected curves, evenly from {}"
_GAPS = "Make the gaps between the selected curves equal from {}"
_DISTRIBUTIONS = tuple(
    _Distribution(axis, spacing, direction, tip.format(ends), number + axis)
    for spacing, tip, number in ((Spacing.CENTRES, _CENTRES, 20), (Spacing.GAPS, _GAPS, 22))
    for axis, direction, ends in ((0, "horizontally", "left to right"), (1, "vertically", "bottom to top"))
)


def _can_align(state: ActionState) -> bool:
    is_one_enough = state.window.align_to.is_around and state.has_selected_curve
    return _count(state) > 1 or (is_one_enough and not state.selected_count)


def _curves(session: Session) -> frozenset[int]:
    """Return the curves to align while no points are selected: the selected or the edited ones."""
    return session.selected.whole_curves or expand_to_shapes(session.document, session.selected.marked)


def _say_what_stays(session: Session, change: Change) -> None:
    if change and (stays := locked_remark(session.document, session.selected.whole_curves)):
        session.say(f"{stays}.")


def _count(state: ActionState) -> int:
    """Return the number of selected points, or else of selected curves; a group or shape counts as one."""
    return state.selected_count or state.whole_count


TWO = Need("at least two selected points or curves (a group counts as one)", _can_align)
THREE = Need(
    "at least three selected points or curves (a group counts as one)", lambda state: _count(state) > 2
)
THREE_CURVES = Need(
    "at least three selected curves (a group counts as one)",
    lambda state: not state.selected_count and state.whole_count > 2,
)


class AlignCommands:
    """Alignment and even spacing: of the selected points, or with none, of the chosen curves."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._store = context.session, context.store

    @action_for_each(
        _ALIGNMENTS,
        lambda alignment: Action(
            action_name("align", alignment.edge),
            alignment.edge.name.capitalize(),
            alignment.section,
            "",
            f"align-{alignment.edge.value}",
            f"Align the selected points or curves {alignment.tip}",
            f"Align {alignment.edge.name.capitalize()}",
            needs=TWO,
        ),
    )
    @also_for_each(lambda alignment: (ALIGN_BUTTONS(alignment.number),))
    def _align(self, alignment: _Alignment) -> None:
        session, group, edge = self._session, self._session.selected.group, alignment.edge
        if group.parts:
            session.change(
                f"Align {group.label} {edge.value}", lambda document: align_points(document, group, edge)
            )
            return
        curves, state = _curves(session), self._store.state

        first, last = session.active_index, session.selected.last

        def aligned(document: Document) -> Document:
            return align_curves(document, session.views, curves, edge, state.align_to, first, last)

        change = session.change(f"Align {name_or_count(session.document, curves)} {edge.value}", aligned)
        _say_what_stays(session, change)

    @action_for_each(
        _DISTRIBUTIONS,
        lambda distribution: Action(
            f"distribute{distribution.what.strip()}{distribution.direction.capitalize()}",
            f"Distribute {distribution.what}{distribution.direction.capitalize()}",
            ARRANGE_DISTRIBUTE,
            icon=f"{distribution.what.strip().lower() or 'distribute'}-{distribution.direction}",
            tip=distribution.tip,
            needs=THREE_CURVES if distribution.spacing is Spacing.GAPS else THREE,
            keywords="space evenly",
        ),
    )
    @also_for_each(lambda distribution: (ALIGN_BUTTONS(distribution.number),))
    def _distribute(self, distribution: _Distribution) -> None:
        session, group = self._session, self._session.selected.group
        if group.parts:
            session.change(
                f"Distribute {group.label} {distribution.direction}",
                lambda document: distribute_points(document, group, distribution.axis),
            )
            return
        curves = unlocked_curves(session.document, session.selected.whole_curves)
        change = session.change(
            f"Distribute {distribution.what.lower()}{'of ' if distribution.what else ''}"
            f"{name_or_count(session.document, curves)} "
            f"{distribution.direction}",
            lambda document: distribute_curves(
                document, session.views, curves, distribution.axis, distribution.spacing
            ),
        )
        _say_what_stays(session, change)

    @action_for_each(
        tuple(Reference),
        lambda reference: Action(
            action_name("alignTo", reference),
            f"To {reference.label[0].lower()}{reference.label[1:]}",
            ARRANGE_ALIGN_TO,
            tip=reference.tip,
            full_name=f"Align to {reference.label[0].lower()}{reference.label[1:]}",
            checked=lambda state: state.window.align_to is reference,
            group="alignTo",
        ),
    )
    def _align_to(self, reference: Reference) -> None:
        self._store.change(align_to=reference)
