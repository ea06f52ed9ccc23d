"""The QActions of a window, made from the declarations of its command sets."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, partial

from PySide6.QtCore import QEvent, QObject, Signal
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QWidget

from ..appearance.icons import icon
from ..appearance.theme import Theme
from ..qt.overrides import SafeOverrides
from ..view_model.curve.curve_view import CurveView
from .declaration import Action, Declared, OpenedEntry, all_declared
from .keymap import (
    Binding,
    Keymap,
    full_name_of,
    keys_text,
    set_full_name,
    set_keywords,
    set_needs,
    set_reason,
    tool_tip,
)
from .menus import MENUS, ActionBar, BarPosition, Menu, MenuSection
from .needs import NOTHING, Need
from .state import ActionFacts, ActionState, DerivedValues, changed_facts

_Run = Callable[[Action, Callable[[], object], bool], object]


class Actions(QObject):
    """The QActions of one window, by name.

    Signals
    -------
    redeclared
        Actions were added, removed or renamed.
    switched
        Other switches are on than before.
    """

    redeclared = Signal()
    switched = Signal()

    def __init__(self, window: QWidget, command_sets: Sequence[type], facts: ActionFacts) -> None:
        super().__init__()
        self.keymap = Keymap(window)
        self._window = self._key_widget = window
        self._facts = facts
        self._gate = KeyGate(facts)
        self._command_sets = command_sets
        self._bound: dict[type, tuple[object, _Run]] = {}
        self._theme: Theme | None = None
        self._groups: dict[str, QActionGroup] = {}
        self._handlers = all_declared(command_sets)
        self._declared = {declared.action.name: declared.action for declared in self._handlers}
        self._actions = {name: self._make(declared) for name, declared in self._declared.items()}
        self._index()
        # The rendered reason of each condition, None where it is met: all actions begin enabled.
        self._missing: dict[tuple[Need, Need], tuple[str, bool] | None] = dict.fromkeys(self._by_needs)
        self._on = set[str]()
        self._opened = set[str]()
        self._opened_of: CurveView | None = None

    def _make(self, declared: Action) -> QAction:
        action = QAction(declared.text, self._window)
        action.setObjectName(declared.name)
        if declared.full_name:
            set_full_name(action, declared.full_name)
        if declared.short:
            action.setIconText(declared.short)
        if declared.keywords:
            set_keywords(action, declared.keywords)
        if declared.needs.words:
            set_needs(action, declared.needs.words)
        action.setStatusTip(declared.tip or declared.text)
        action.setCheckable(declared.checked is not None)
        if declared.group:
            if declared.group not in self._groups:
                self._groups[declared.group] = QActionGroup(self._window)
            self._groups[declared.group].addAction(action)
        name = full_name_of(action).removesuffix("…")
        self.keymap.add(Binding(action, name, declared.section.menu.title, _sequences(declared.key)))
        if declared.key_needs is not NOTHING:
            self._gate.guard(action, declared.key_needs)
        return action

    def _index(self) -> None:
        """Index actions by the facts to render, so that rendering does not search hundreds of them."""
        declared = [(item, self._actions[name]) for name, item in self._declared.items()]
        switches = {name: item.is_on for name, item in self._declared.items() if item.checked is not None}
        self._are_on = DerivedValues(switches)
        self._titles = DerivedValues(
            {action: item.title for item, action in declared if item.title is not None}
        )
        # Actions with the same conditions are enabled together, and asked about once.
        self._by_needs: dict[tuple[Need, Need], list[QAction]] = {}
        for item, action in declared:
            self._by_needs.setdefault(_needs_of(item), []).append(action)
        self._reasons = DerivedValues({needs: partial(_reason_missing, needs) for needs in self._by_needs})
        self._missing = {}
        self._rendered: ActionState | None = None
        self._by_section: dict[MenuSection, list[QAction]] = {}
        for item, action in declared:
            self._by_section.setdefault(item.section, []).append(action)
        self._by_bar = self._sorted_by_bar()

    def _sorted_by_bar(self) -> dict[ActionBar, dict[int, list[QAction | MenuSection]]]:
        """Return the entries of each bar in the order of their positions, grouped by tens."""
        entries: list[tuple[BarPosition, QAction | MenuSection]]
        entries = [(at, self[item.action.name]) for item in self._handlers for at in item.positions]
        entries += [(position, item) for menu in MENUS for item in menu.sections for position in item.also]
        by_bar: dict[ActionBar, dict[int, list[QAction | MenuSection]]] = {}
        for position, entry in sorted(entries, key=lambda pair: pair[0].number):
            by_bar.setdefault(position.bar, {}).setdefault(position.number // 10, []).append(entry)
        return by_bar

    def bind(self, commands: object, run: _Run) -> None:
        """Connect the actions that a command set declares to its handlers, through `run`."""
        self._bound[type(commands)] = commands, run
        for declared in self._handlers:
            if declared.commands is type(commands):
                self._connect(declared)

    def _connect(self, declared: Declared) -> None:
        commands, run = self._bound[declared.commands]
        act = partial(run, declared.action, declared.bound_to(commands))
        self._actions[declared.action.name].triggered.connect(act)

    def declare_again(self) -> None:
        """Add actions of new records, remove those of records that are gone, and rename the others."""
        self._handlers = all_declared(self._command_sets)
        before, after = self._declared, {declared.action.name: declared for declared in self._handlers}
        self._declared = {name: declared.action for name, declared in after.items()}
        new = self._declared.keys() - before.keys()
        for name in before.keys() - self._declared.keys():
            self._remove(name)
        for name in self._declared.keys() & before.keys():
            self._rename(name, before[name])
        # In the order of the menus: it decides which action gets a key.
        for name in [declared for declared in self._declared if declared in new]:
            action = self._actions[name] = self._make(self._declared[name])
            self._connect(after[name])
            self._key_widget.addAction(action)
        if self._theme is not None:
            self.set_theme(self._theme)
        self._index()
        self.render()
        self.redeclared.emit()

    def _remove(self, name: str) -> None:
        action = self._actions.pop(name)
        self._opened.discard(name)
        self._on.discard(name)
        self.keymap.remove(name)
        self._gate.release(action)
        # Removed from all menus at once, and not found by name until it is deleted.
        action.setVisible(False)
        action.setObjectName("")
        self._key_widget.removeAction(action)
        action.deleteLater()

    def _rename(self, name: str, before: Action) -> None:
        """Update the texts of an action to those of its record."""
        action, now = self._actions[name], self._declared[name]
        if (now.text, now.tip, now.full_name) != (before.text, before.tip, before.full_name):
            action.setText(now.text)
            set_full_name(action, now.full_name)
            action.setStatusTip(now.tip or now.text)
            action.setToolTip(tool_tip(action))

    def attach(self, widget: QWidget) -> None:
        """Add the actions to `widget`, which is always visible, so that keys work while menus are hidden.

        Called late, because every change of an action is an event for the widget, hundreds with each
        document; and not for the window, whose events are filtered.
        """
        self._key_widget = widget
        widget.addActions(list(self._actions.values()))

    def __getitem__(self, name: str) -> QAction:
        return self._actions[name]

    def __contains__(self, name: str) -> bool:
        return name in self._actions

    def declared_by(self, commands: type) -> list[QAction]:
        """Return the actions that a command set declares."""
        return [self[declared.action.name] for declared in self._handlers if declared.commands is commands]

    def in_section(self, section: MenuSection) -> list[QAction]:
        """Return the actions of a section of a menu, in order."""
        return self._by_section.get(section, [])

    def in_bar(self, bar: ActionBar) -> dict[int, list[QAction]]:
        """Return the actions of a bar in order, grouped by the tens of their positions."""
        groups = self.with_sections(bar).items()
        return {ten: [entry for entry in group if isinstance(entry, QAction)] for ten, group in groups}

    def choices_of(self, action: QAction) -> ActionBar | None:
        """Return the bar of switches in the menu of the toolbar button; None where it has no menu."""
        declared = self._declared.get(action.objectName())
        return declared.choices if declared is not None else None

    def with_sections(self, bar: ActionBar) -> dict[int, list[QAction | MenuSection]]:
        """Return the actions of a bar, and the sections that are submenus there, grouped by tens."""
        return self._by_bar.get(bar, {})

    def of_menu(self, menu: Menu) -> Iterator[tuple[Action, QAction]]:
        """Yield the actions of `menu`, in order."""
        for described in self._declared.values():
            if described.section.menu is menu:
                yield described, self._actions[described.name]

    def shortcuts(self, menu: Menu) -> list[tuple[str, str]]:
        """Return (keys, tip) of the enabled actions of `menu`."""
        rows = []
        for described, action in self.of_menu(menu):
            keys = keys_text(action.shortcuts())
            if keys and action.isEnabled():
                rows.append((keys, described.tip or described.text))
        return rows

    def button_text(self, action: QAction, *, short: bool) -> str:
        """Return the text of a toolbar button; empty where the icon is enough."""
        described = self._declared[action.objectName()]
        return described.short if short or not described.short else described.text

    def is_on(self, name: str) -> bool:
        """Return whether a switch is on; False for other actions and unknown names."""
        return name in self._on

    def follow(self) -> None:
        """Render at the end of the current batch of changes."""
        self._facts.session.batch.then(self.render)

    def render(self) -> None:
        """Enable, check and name the actions whose facts have changed."""
        state, session = self._facts.read(), self._facts.session
        if state == self._rendered and (not self._opened or session.active_view is self._opened_of):
            return
        changed = changed_facts(self._rendered, state) if self._rendered is not None else set[str]()
        self._reset_opened()
        for needs, missing in self._reasons.renewed(state, changed):
            if needs not in self._missing or self._missing[needs] != missing:
                self._missing[needs] = missing
                for action in self._by_needs[needs]:
                    _enable(action, *(missing or (None,)))
        self._check(dict(self._are_on.renewed(state, changed)))
        for action, title in self._titles.renewed(state, changed):
            action.setText(title)
        # Last: after an exception the next call compares with the same facts again.
        self._rendered = state

    def show_checked(self, name: str) -> None:
        """Show the true state of a switch that was clicked, and of its group: Qt has toggled it already."""
        # The action itself may have removed its record.
        action = self._actions.get(name)
        if action is not None and action.isCheckable():
            group = action.actionGroup()
            for switch in group.actions() if group is not None else (action,):
                switch.setChecked(switch.objectName() in self._on)

    def _check(self, are_on: Mapping[str, bool]) -> None:
        """Check the actions that are on, and uncheck those that are off."""
        others = [name for name, is_on in are_on.items() if is_on != (name in self._on)]
        self._on = self._on.symmetric_difference(others)
        for name in sorted(others, key=self._on.__contains__):
            self._actions[name].setChecked(name in self._on)
        if others:
            self.switched.emit()

    def open_section(self, section: MenuSection) -> None:
        """Set the texts and states of a section that are computed only when its menu opens.

        They stay until actions are rendered for other facts or another curve.
        """
        state, session = self._facts.read(), self._facts.session
        if self._opened and self._opened_of is session.active_view:
            return
        self._opened_of = session.active_view
        for item in self._declared.values():
            if item.section is section and item.when_opened is not None and item.missing(state) is None:
                self._show_entry(item.name, item.when_opened(session))

    def _show_entry(self, name: str, opened: OpenedEntry) -> None:
        action = self._actions[name]
        action.setText(opened.text)
        action.setStatusTip(opened.tip)
        _enable(action, opened.reason or None)
        self._opened.add(name)

    def _reset_opened(self) -> None:
        """Restore the declared texts and states of actions."""
        for name in self._opened:
            action, described = self._actions[name], self._declared[name]
            action.setText(described.text)
            action.setStatusTip(described.tip)
            _enable(action, *(self._missing.get(_needs_of(described)) or (None,)))
        self._opened.clear()

    def set_theme(self, theme: Theme) -> None:
        """Tint the icons for `theme`."""
        self._theme = theme
        for name, described in self._declared.items():
            if described.icon:
                self._actions[name].setIcon(icon(described.icon, theme))


def _needs_of(action: Action) -> tuple[Need, Need]:
    return action.section.needs, action.needs


def _reason_missing(needs: tuple[Need, Need], state: ActionState) -> tuple[str, bool] | None:
    """Return the reason of the first condition that is not met, and whether the action is redundant."""
    return next(((need.reason(state), need.is_redundant) for need in needs if not need.is_met(state)), None)


def _enable(action: QAction, why_not: str | None, is_redundant: bool = False) -> None:
    """Enable an action, or disable it for a reason, which is empty for the usual sentence."""
    set_reason(action, why_not or "", is_redundant=is_redundant)
    action.setEnabled(why_not is None)
    action.setToolTip(tool_tip(action))


@cache
def _sequences(keys: str) -> tuple[QKeySequence, ...]:
    return tuple(QKeySequence(part) for part in keys.split(", ")) if keys else ()


class KeyGate(SafeOverrides, QObject):
    """Filter that refuses keys of actions whose key condition is not met; buttons and menus still work."""

    def __init__(self, facts: ActionFacts) -> None:
        super().__init__()
        self._facts = facts
        self._guarded: dict[str, Need] = {}

    def guard(self, action: QAction, needs: Need) -> None:
        """Refuse the keys of `action` where `needs` is not met."""
        self._guarded[action.objectName()] = needs
        action.installEventFilter(self)

    def release(self, action: QAction) -> None:
        """Stop guarding the keys of `action`, which still has its name."""
        if self._guarded.pop(action.objectName(), None) is not None:
            action.removeEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Consume a key that is refused, and say why."""
        if event.type() is not QEvent.Type.Shortcut:
            return False
        needs, state = self._guarded[watched.objectName()], self._facts.read()
        if needs.is_met(state):
            return False
        self._facts.session.refuse(needs.reason(state))
        return True
