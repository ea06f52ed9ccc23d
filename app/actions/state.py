"""Facts that decide which actions are enabled, which are on, and how they are named.

Actions are rendered when these facts have changed. So no fact is a position or a text that changes in a drag.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence, Set
from operator import attrgetter
from typing import Any, Generic, TypeVar, cast

import msgspec
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QGuiApplication

from ..document.derivatives import EstimateRule
from ..document.group_edits import are_in_groups, nodes_of
from ..document.groups import NodeKind, expand_to_shapes, shape_of, whole_nodes
from ..document.model import Document, ParametrizationKind
from ..document.point_edits import explicit_points
from ..document.point_group import PointGroup
from ..document.several_curves import count_label, is_blank
from ..families import Family
from ..session import Session
from ..state.window_state import WindowState, WindowStore
from ..view_model.curve.curve_view import CurveView
from ..view_model.join import link_of
from ..view_model.point_kinds import POINT_KINDS, inner_points, kinds_of

_VISIBLE, _LOCKED = attrgetter("visible"), attrgetter("locked")


class ActionState(msgspec.Struct, frozen=True, kw_only=True):
    """Facts that decide about actions: equal facts, equal actions.

    "The curve" is the active one: `point_count`, `active_selected_count` and `has_copied_derivatives` are
    about its points alone, the other facts about points are about those of all edited curves. To add a fact,
    add a field here and read it in `ActionFacts.read`.

    Attributes
    ----------
    window
        The window's state.
    is_blank
        Whether nothing has been drawn yet.
    curve_count
        The number of curves.
    curve_name
        The name of the curve.
    family, parametrization, rules
        The rules of the curve; `rules` by the order of the estimated derivative, from 1 on.
    point_count
        The number of its points.
    is_closed, is_visible, is_locked, is_in_shape
        Flags of the curve, and whether it belongs to a shape of several curves.
    is_current, has_curve
        Whether its points make a curve; whether a curve is drawn, which may be the last valid one.
    is_editing
        Whether a curve is edited.
    highlighted
        Title of the curves that are duplicated and deleted: "3 Curves", "Group", "Contour" (of a shape).
    has_selected_curve, selected_curve_count
        Whether any curve is edited or selected; the number of curves that are worked on together.
    whole_count
        The number of things selected as wholes; a whole group or shape counts as one.
    can_combine, is_any_in_shape, is_any_in_group
        Whether the selected curves are several and not one shape; whether any is in a shape, or in a group.
    is_any_hidden, is_any_locked
        Whether any curve of the document is hidden, or locked.
    has_curve_in_front, has_curve_behind
        Whether the selection can move a step to the front or to the back.
    selected_count, active_selected_count
        The number of selected points, of all curves and of the active one.
    point_kinds
        The kinds of the selected points, as indices in `POINT_KINDS`.
    has_explicit, has_newly_set
        Whether a selected point has a derivative set by hand; whether the last step has set some to keep the
        shape.
    has_two_ends
        Whether two ends of open curves are selected and nothing else.
    can_undo, can_redo, can_go_back
        Whether there is a step to undo or redo; whether a lesson or an example has replaced other work.
    has_scrub_line, grips_turn
        Whether the scrub line is shown; whether the grips of the box rotate and skew.
    has_copied_derivatives
        Whether derivatives on the clipboard could be pasted to selected points.
    has_guides
        Whether there are guides.
    is_image_locked
        Whether the reference image is locked; None without one.
    """

    window: WindowState
    is_blank: bool
    curve_count: int
    curve_name: str
    family: Family
    parametrization: ParametrizationKind
    rules: tuple[EstimateRule, ...]
    point_count: int
    is_closed: bool
    is_visible: bool
    is_locked: bool
    is_in_shape: bool
    is_current: bool
    has_curve: bool
    is_editing: bool
    highlighted: str
    has_selected_curve: bool
    selected_curve_count: int
    whole_count: int
    can_combine: bool
    is_any_in_shape: bool
    is_any_in_group: bool
    is_any_hidden: bool
    is_any_locked: bool
    has_curve_in_front: bool
    has_curve_behind: bool
    selected_count: int
    active_selected_count: int
    point_kinds: frozenset[int]
    has_explicit: bool
    has_newly_set: bool
    has_two_ends: bool
    can_undo: bool
    can_redo: bool
    can_go_back: bool
    has_scrub_line: bool
    grips_turn: bool
    has_copied_derivatives: bool
    has_guides: bool
    is_image_locked: bool | None

    @property
    def has_derivatives(self) -> bool:
        """Whether the points of the curve have velocities."""
        return self.family.derivatives > 0


class ActionFacts:
    """Reader of the facts of one window."""

    def __init__(self, session: Session, store: WindowStore, clipboard: ClipboardWatch) -> None:
        self.session, self._store, self._clipboard = session, store, clipboard

    def read(self) -> ActionState:
        """Return the current facts."""
        session, window = self.session, self._store.state
        document, selected, active = session.document, session.selected, session.active_index
        view, group, stack = session.active_view, selected.group, session.undo_stack
        source, points, marked = view.source, selected.points, selected.marked
        whole, shape = expand_to_shapes(document, marked), shape_of(document, active)
        has_derivative_points = bool(group.parts) and source.family.derivatives > 0 and view.is_current
        return ActionState(
            window=window,
            is_blank=is_blank(document),
            curve_count=len(document.curves),
            curve_name=source.name,
            family=source.family,
            parametrization=source.parametrization.kind,
            rules=source.rules,
            point_count=len(source.points),
            is_closed=source.is_closed,
            is_visible=source.visible,
            is_locked=source.locked,
            is_in_shape=bool(source.shape),
            is_current=view.is_current,
            has_curve=view.curve is not None,
            is_editing=selected.is_editing,
            highlighted=_highlighted(session),
            has_selected_curve=bool(marked),
            selected_curve_count=len(selected.curves),
            whole_count=len(nodes_of(document, whole)) if len(whole) > 1 else len(whole),
            can_combine=bool(whole) and not whole <= set(shape_of(document, min(whole))),
            is_any_in_shape=any(document.curves[curve].shape for curve in whole),
            is_any_in_group=are_in_groups(document, whole),
            is_any_hidden=not all(map(_VISIBLE, document.curves)),
            is_any_locked=any(map(_LOCKED, document.curves)),
            has_curve_in_front=_has_curve_beside(document, selected.curves, shape, 1),
            has_curve_behind=_has_curve_beside(document, selected.curves, shape, -1),
            selected_count=group.count,
            active_selected_count=len(points),
            point_kinds=_kinds(session.views, group) if has_derivative_points else frozenset(),
            has_explicit=any(explicit_points(document.curves[curve], of) for curve, of in group.parts),
            has_newly_set=bool(session.newly_set.parts),
            has_two_ends=link_of(session.views, group) is not None,
            can_undo=stack.canUndo() or session.is_previewing or window.in_flight or window.undoes_discard,
            can_redo=stack.canRedo(),
            can_go_back=session.files.origin.before is not None,
            has_scrub_line=session.scrub.t is not None,
            grips_turn=session.box.turns,
            has_copied_derivatives=(
                bool(points) and source.family.derivatives > 0 and self._clipboard.holds_derivatives
            ),
            has_guides=bool(document.guides),
            is_image_locked=document.image.locked if document.image is not None else None,
        )


def _highlighted(session: Session) -> str:
    document, selected = session.document, session.selected
    curves = selected.for_clipboard(whole_curves=True).curves or selected.with_shapes
    nodes = whole_nodes(document.curves, curves)
    if len(nodes) > 1:
        return count_label(document, curves).title().replace(" And ", " and ")
    (node,) = nodes
    is_contour = node.kind is NodeKind.CURVE and node.container.shape
    return "Contour" if is_contour else node.kind.name.title()


def _has_curve_beside(document: Document, selected: frozenset[int], shape: range, step: int) -> bool:
    """Return whether the selection, or a part of it, can move a step to the front (1) or to the back (−1)."""
    curves = document.curves
    if not selected <= set(shape):
        return len(selected) < len(curves)
    beside = shape.stop if step > 0 else shape.start - 1
    groups = curves[shape.start].groups
    return 0 <= beside < len(curves) and curves[beside].groups[: len(groups)] == groups


def _kinds(views: Sequence[CurveView], group: PointGroup) -> frozenset[int]:
    """Return the kinds that points are of, as indices in `POINT_KINDS`; ends of open curves have few."""
    kinds = set[int]()
    for curve, indices in group.parts:
        found, inner = kinds_of(views[curve]).tolist(), inner_points(views[curve].source, indices)
        kinds |= {found[index] for index in indices if index in inner or not POINT_KINDS[found[index]].ends}
    return frozenset(kinds)


DERIVATIVES = "application/x-curvebench-derivatives"
"""MIME type of the derivatives of a point, stored as a point whose position is ignored."""


class ClipboardWatch(QObject):
    """Cached answer to whether there are derivatives on the clipboard.

    Another program may have to be asked, so it is asked only when needed, and once.

    Signals
    -------
    changed
        The content of the clipboard has changed.
    """

    changed = Signal()

    def __init__(self, window: QObject) -> None:
        # A child of the window: the clipboard lives longer.
        super().__init__(window)
        self._known: bool | None = None
        QGuiApplication.clipboard().dataChanged.connect(self._forget)

    @property
    def holds_derivatives(self) -> bool:
        """Whether the clipboard contains derivatives now."""
        if self._known is None:
            data = QGuiApplication.clipboard().mimeData()
            self._known = data is not None and data.hasFormat(DERIVATIVES)
        return self._known

    def _forget(self) -> None:
        self._known = None
        self.changed.emit()


_Key = TypeVar("_Key", bound=Hashable)
_Value = TypeVar("_Value")

_WINDOW = "window"
"""The fact with facts of its own: an action that shows the grid does not depend on the tool."""


class DerivedValues(Generic[_Key, _Value]):
    """Values by key, each computed again only where a fact that it read has changed."""

    def __init__(self, computes: Mapping[_Key, Callable[[ActionState], _Value]]) -> None:
        self._computes = computes
        # The facts that each value has read; none for values that are not computed yet.
        self._reads: dict[_Key, set[str]] = {}

    def renewed(self, state: ActionState, changed: Set[str]) -> Iterator[tuple[_Key, _Value]]:
        """Yield the values that read any of the facts `changed`, and those not computed yet."""
        reads = self._reads
        for key in [key for key in self._computes if key not in reads or not reads[key].isdisjoint(changed)]:
            read = set[str]()
            value = self._computes[key](cast("ActionState", _Reader(state, read)))
            reads[key] = read
            yield key, value


class _Reader:
    """Record of facts that notes the names of the facts that are read."""

    def __init__(self, facts: ActionState | WindowState, read: set[str], prefix: str = "") -> None:
        self._facts, self._read_names, self._prefix = facts, read, prefix

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - as the type of the fact
        if name not in self._facts.__struct_fields__:
            # A property or method: the facts that it reads are noted.
            return getattr(type(self._facts), name).__get__(self)
        if name == _WINDOW:
            return _Reader(getattr(self._facts, name), self._read_names, f"{name}.")
        self._read_names.add(self._prefix + name)
        return getattr(self._facts, name)


def changed_facts(before: ActionState, after: ActionState) -> Set[str]:
    """Return the names of the facts that differ; those of the window begin with "window."."""
    return _differences(before, after) - {_WINDOW} | {
        f"{_WINDOW}.{name}" for name in _differences(before.window, after.window)
    }


def _differences(before: msgspec.Struct, after: msgspec.Struct) -> set[str]:
    if before is after:
        return set()
    return {name for name in after.__struct_fields__ if getattr(before, name) != getattr(after, name)}
