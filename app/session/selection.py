"""Ways to select points and curves."""

from __future__ import annotations

from collections.abc import Collection

from ..document.groups import expand_to_shapes
from ..document.point_group import NO_POINTS, PointGroup, group_points
from ..document.selection import SelectionState, existing_points
from ..document.style import Style
from .selected import Selected


class Selection(Selected):
    """What is selected, and the ways to select something else, of which the session's signals tell."""

    def set_points(self, indices: Collection[int]) -> None:
        """Select points of the active curve alone, those that exist; it is edited with any."""
        self.set_group(group_points([(self._session.active_index, frozenset(map(int, indices)))]))

    def set_group(self, group: PointGroup) -> None:
        """Select points of the curves that are edited, those that exist.

        The active curve is edited with any, and one of those with some: the one so far, or the nearest to it.
        """
        active = self._session.active_index
        if not self.is_editing and existing_points(group, self._session.document.curves, {active}).parts:
            self.activate(active)
        existing = self._existing(group)
        if existing.parts and not existing.of(active):
            self._turn_to(min(existing.curves, key=lambda curve: abs(curve - active)))
        self._put(existing)

    def show_group(self, group: PointGroup) -> None:
        """Show points as selected while a gesture goes on, perhaps none of the active curve.

        `set_group` or `restore` ends it.
        """
        self._put(self._existing(group))

    def keep_group(self, group: PointGroup) -> None:
        """Select what exists of some points: nothing, where that is nothing of the active curve."""
        existing = self._existing(group)
        self._put(existing if existing.of(self._session.active_index) else NO_POINTS)

    def _existing(self, group: PointGroup) -> PointGroup:
        return (
            existing_points(group, self._session.document.curves, self.edited) if group.parts else NO_POINTS
        )

    def _put(self, group: PointGroup) -> None:
        if group != self.group:
            self.group = group
            self._session.box.set_turns(False)
            self._session.history.end_run()
            self._session.selection_changed.emit(self.points)

    def set_hovered(self, index: int) -> None:
        """Take note of the point under the pointer; -1 for none."""
        before, count = self.hovered, len(self._session.active_curve.points)
        self.hovered = index if 0 <= index < count else -1
        if self.hovered != before:
            self._session.hovered_changed.emit(self.hovered)

    # Curves

    def activate(self, index: int) -> None:
        """Edit a curve, and select it alone; of another one nothing is selected yet."""
        self._take((index,), index, is_editing=True)

    def edit_chosen(self) -> None:
        """Edit what is chosen: several shapes together, or the active curve with its shape."""
        active = self._session.active_index
        others = self._chosen - expand_to_shapes(self._session.document, (active,))
        self._take((*self._chosen, active) if others else (active,), active, is_editing=True)

    def go_to(self, index: int) -> None:
        """Make another of the curves that are edited the active one; the same points are selected."""
        group = self.group
        self._turn_to(index)
        self._put(group)

    def _turn_to(self, index: int) -> None:
        self._take((*(self.curves if len(self.curves) > 1 else ()), index), index, is_editing=True)

    def choose(self, indices: Collection[int]) -> None:
        """Choose curves as wholes, those that exist, or none at all; no curve is edited any more.

        Curves of one shape are chosen together. The active one is one of them, as `set_curves` has it.
        """
        document = self._session.document
        places = [index for index in indices if 0 <= index < len(document.curves)]
        self._take(expand_to_shapes(document, places), is_editing=False)

    def take_up(self) -> None:
        """Edit the active curve, for a tool that needs one; where nobody chose it, it is lent."""
        is_lent, style = self.is_lent or not self.marked, self.next_style
        self.activate(self._session.active_index)
        self.is_lent, self.next_style = is_lent, style

    def choose_brought(self, indices: Collection[int], style: Style) -> None:
        """Choose curves that were brought here; what is drawn next has this style, not theirs."""
        self.choose(indices)
        self.next_style = style

    def show_choice(self, indices: Collection[int]) -> None:
        """Show curves as chosen while a gesture goes on; `choose` or `restore` ends it."""
        self._chosen = frozenset(indices)
        self._session.selected_curves_changed.emit(self.curves)

    def show(self, state: SelectionState) -> None:
        """Show points or whole curves as selected while a gesture goes on."""
        if state.is_editing:
            self.set_group(state.points)
        else:
            self.show_choice(state.chosen)

    def set_curves(self, indices: Collection[int], active: int | None = None) -> None:
        """Select curves to work on together, those that exist.

        The active curve is one of them: `active`, or the one so far, or the selected one nearest to it. With
        several no points are selected, so that tools act on the curves.
        """
        wanted = self._session.active_index if active is None else active
        self._take(indices or (wanted,), active, is_editing=self.is_editing)

    def _take(self, indices: Collection[int], active: int | None = None, *, is_editing: bool) -> None:
        session = self._session
        if session.is_previewing:
            # The gesture may edit a curve that goes with its preview.
            session.interrupt()
        before, places = self.choice, range(len(session.document.curves))
        wanted = active if active is not None and active in places else session.active_index
        existing = frozenset(index for index in indices if index in places)
        if wanted not in existing:
            wanted = min(existing, key=lambda index: abs(index - wanted), default=wanted)
        self.hold((*existing, wanted), existing, is_editing=is_editing)
        self.is_lent = False
        if existing:
            self.next_style = None
        if wanted != session.active_index:
            session.interrupted.emit()
            session.cancel()
            self.enter(wanted)
            self._session.scrub.keep()
            session.active_changed.emit(wanted)
        # No point stays selected of a curve that is not edited any more.
        self.keep_group(NO_POINTS if self.chosen or not is_editing else self.group)
        self.last = max(existing - before.curves, default=self.last if self.last in existing else wanted)
        if (self.curves, self.chosen, self.is_editing) != (before.curves, before.chosen, before.is_editing):
            self._session.box.set_turns(False)
            session.selected_curves_changed.emit(self.curves)

    def restore(self, choice: SelectionState) -> None:
        """Select what was selected before; the active curve is the one of then already."""
        self._take(choice.curves if choice.is_editing else choice.chosen, is_editing=choice.is_editing)
        self.set_group(choice.points)

    def enter(self, index: int) -> None:
        """Make curve `index` the active one; what belonged to the other is put away."""
        self.set_points([])
        self.set_hovered(-1)
        self._session.active_index = index

    def hold(self, curves: Collection[int], chosen: Collection[int] = (), *, is_editing: bool = True) -> None:
        """Have these curves be the selected ones, and tell nobody; `chosen` of them where none is edited."""
        self.curves, self.is_editing = frozenset(curves), is_editing
        self._chosen = frozenset() if is_editing else frozenset(chosen)
