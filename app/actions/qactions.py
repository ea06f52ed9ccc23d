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
from .declaration import Action, Declared, Opened, all_declared
from .keymap import (
    Binding,
    Keymap,
    full_name_of,
    keys_text,
    say_needs,
    say_reason,
    set_full_name,
    set_keywords,
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
        There are other actions than before, or they are called otherwise.
    switched
        Others than before are on, or another bar of the toolbar is to be worked with.
    """

    redeclared = Signal()
    switched = Signal()

    def __init__(self, window: QWidget, command_sets: Sequence[type], facts: ActionFacts) -> None:
        super().__init__()
        self.keymap = Keymap(window)
        self._window = self._hearer = window
        self._facts = facts
        self._gate = KeyGate(facts)
        self._command_sets = command_sets
        self._bound: dict[type, tuple[object, _Run]] = {}
        self._theme: Theme | None = None
        self._groups: dict[str, QActionGroup] = {}
        self._handlers = all_declared(command_sets)
        self._declared = {each.action.name: each.action for each in self._handlers}
        self._actions = {name: self._make(each) for name, each in self._declared.items()}
        self._sort_out()
        # What each is shown to lack, None for nothing: as they are made, all can be used.
        self._missing: dict[tuple[Need, Need], tuple[str, bool] | None] = dict.fromkeys(self._alike)
        self._on = set[str]()
        self._opened = set[str]()
        self._opened_of: CurveView | None = None

    def _make(self, each: Action) -> QAction:
        action = QAction(each.text, self._window)
        action.setObjectName(each.name)
        if each.full_name:
            set_full_name(action, each.full_name)
        if each.keywords:
            set_keywords(action, each.keywords)
        if each.needs.words:
            say_needs(action, each.needs.words)
        action.setStatusTip(each.tip or each.text)
        action.setCheckable(each.checked is not None)
        if each.group:
            if each.group not in self._groups:
                self._groups[each.group] = QActionGroup(self._window)
            self._groups[each.group].addAction(action)
        name = full_name_of(action).removesuffix("…")
        self.keymap.add(Binding(action, name, each.section.menu.title, _sequences(each.key)))
        if each.key_needs is not NOTHING:
            self._gate.guard(action, each.key_needs)
        return action

    def _sort_out(self) -> None:
        """Find what has to be asked about each: all the time, so nobody looks through hundreds for it."""
        declared = [(each, self._actions[name]) for name, each in self._declared.items()]
        switches = {name: each.is_on for name, each in self._declared.items() if each.checked is not None}
        self._are_on = DerivedValues(switches)
        self._titles = DerivedValues(
            {action: each.title for each, action in declared if each.title is not None}
        )
        # Those with the same needs are enabled together, and asked about once.
        self._alike: dict[tuple[Need, Need], list[QAction]] = {}
        for each, action in declared:
            self._alike.setdefault(_needs_of(each), []).append(action)
        self._whys_not = DerivedValues({needs: partial(_why_not, needs) for needs in self._alike})
        self._missing = {}
        self._rendered: ActionState | None = None
        self._by_section: dict[MenuSection, list[QAction]] = {}
        for each, action in declared:
            self._by_section.setdefault(each.section, []).append(action)
        self._by_bar = self._sorted_by_bar()

    def _sorted_by_bar(self) -> dict[ActionBar, dict[int, list[QAction | MenuSection]]]:
        """Return what stands in bars, in the order of their places there and by the tens of these."""
        places: list[tuple[BarPosition, QAction | MenuSection]]
        places = [(place, self[each.action.name]) for each in self._handlers for place in each.places]
        places += [(place, each) for menu in MENUS for each in menu.sections for place in each.also]
        found: dict[ActionBar, dict[int, list[QAction | MenuSection]]] = {}
        for place, entry in sorted(places, key=lambda pair: pair[0].number):
            found.setdefault(place.bar, {}).setdefault(place.number // 10, []).append(entry)
        return found

    def bind(self, commands: object, run: _Run) -> None:
        """Let the actions that a command set declares be carried out by it, each through `run`."""
        self._bound[type(commands)] = commands, run
        for each in self._handlers:
            if each.commands is type(commands):
                self._connect(each)

    def _connect(self, each: Declared) -> None:
        commands, run = self._bound[each.commands]
        act = partial(run, each.action, each.bound_to(commands))
        self._actions[each.action.name].triggered.connect(act)

    def declare_again(self) -> None:
        """Take in actions of records that have come, give up those of ones that are gone, rename the rest."""
        self._handlers = all_declared(self._command_sets)
        before, after = self._declared, {each.action.name: each for each in self._handlers}
        self._declared = {name: each.action for name, each in after.items()}
        new = self._declared.keys() - before.keys()
        for name in before.keys() - self._declared.keys():
            self._give_up(name)
        for name in self._declared.keys() & before.keys():
            self._rename(name, before[name])
        # In the order of the menus: keys are given out by place.
        for name in [each for each in self._declared if each in new]:
            action = self._actions[name] = self._make(self._declared[name])
            self._connect(after[name])
            self._hearer.addAction(action)
        if self._theme is not None:
            self.set_theme(self._theme)
        self._sort_out()
        self.render()
        self.redeclared.emit()

    def _give_up(self, name: str) -> None:
        action = self._actions.pop(name)
        self._opened.discard(name)
        self._on.discard(name)
        self.keymap.remove(name)
        self._gate.release(action)
        # Gone from all menus at once, and found by nobody until it is deleted.
        action.setVisible(False)
        action.setObjectName("")
        self._hearer.removeAction(action)
        action.deleteLater()

    def _rename(self, name: str, before: Action) -> None:
        """Call an action what its record is called now."""
        action, now = self._actions[name], self._declared[name]
        if (now.text, now.tip, now.full_name) != (before.text, before.tip, before.full_name):
            action.setText(now.text)
            set_full_name(action, now.full_name)
            action.setStatusTip(now.tip or now.text)
            action.setToolTip(tool_tip(action))

    def attach(self, hearer: QWidget) -> None:
        """Let `hearer`, which is always shown, hear the keys: in menus alone they die while these are hidden.

        Late: from then on every change of an action is an event for it, hundreds with each document. So it is
        not the window, whose events we look through.
        """
        self._hearer = hearer
        hearer.addActions(list(self._actions.values()))

    def __getitem__(self, name: str) -> QAction:
        return self._actions[name]

    def __contains__(self, name: str) -> bool:
        return name in self._actions

    def declared_by(self, commands: type) -> list[QAction]:
        """Return the actions that a command set declares."""
        return [self[each.action.name] for each in self._handlers if each.commands is commands]

    def in_section(self, section: MenuSection) -> list[QAction]:
        """Return the actions of a section of a menu, in order."""
        return self._by_section.get(section, [])

    def in_bar(self, bar: ActionBar) -> dict[int, list[QAction]]:
        """Return the actions of a bar by the tens of their places, in order."""
        groups = self.with_sections(bar).items()
        return {ten: [each for each in group if isinstance(each, QAction)] for ten, group in groups}

    def choices_of(self, action: QAction) -> ActionBar | None:
        """Return the bar of switches that the button of an action offers; None where it has none."""
        declared = self._declared.get(action.objectName())
        return declared.choices if declared is not None else None

    def with_sections(self, bar: ActionBar) -> dict[int, list[QAction | MenuSection]]:
        """Return the actions of a bar, and the sections that are submenus there, by their tens."""
        return self._by_bar.get(bar, {})

    def of_menu(self, menu: Menu) -> Iterator[tuple[Action, QAction]]:
        """Yield the actions that stand in `menu`, in order."""
        for each in self._declared.values():
            if each.section.menu is menu:
                yield each, self._actions[each.name]

    def shortcuts(self, menu: Menu) -> list[tuple[str, str]]:
        """Return (keys, what they do) of the actions of `menu` that can be used now."""
        rows = []
        for each, action in self.of_menu(menu):
            keys = keys_text(action.shortcuts())
            if keys and action.isEnabled():
                rows.append((keys, each.tip or each.text))
        return rows

    def words_of(self, action: QAction, *, short: bool) -> str:
        """Return what a button says of an action beside its icon; empty where that is enough."""
        each = self._declared[action.objectName()]
        return each.short if short or not each.short else each.text

    def is_on(self, name: str) -> bool:
        """Whether what an action switches is on; False of what is no switch, or is there no more."""
        return name in self._on

    def follow(self) -> None:
        """Render, when all is told of which there is news."""
        self._facts.session.batch.then(self.render)

    def render(self) -> None:
        """Enable, check and name all actions, where the facts that decide about them have changed."""
        state, session = self._facts.read(), self._facts.session
        if state == self._rendered and (not self._opened or session.active_view is self._opened_of):
            return
        changed = changed_facts(self._rendered, state) if self._rendered is not None else set[str]()
        self._take_back_opened()
        for needs, missing in self._whys_not.renewed(state, changed):
            if needs not in self._missing or self._missing[needs] != missing:
                self._missing[needs] = missing
                for action in self._alike[needs]:
                    _enable(action, *(missing or (None,)))
        self._check(dict(self._are_on.renewed(state, changed)))
        for action, title in self._titles.renewed(state, changed):
            action.setText(title)
        # Last: where something raises, the next time asks about these facts again.
        self._rendered = state

    def take_back_click(self, name: str) -> None:
        """Let a switch that was clicked, and those that went off with it, show what is on."""
        # It may be there no more: its record went with what it did.
        action = self._actions.get(name)
        if action is not None and action.isCheckable():
            group = action.actionGroup()
            for each in group.actions() if group is not None else (action,):
                each.setChecked(each.objectName() in self._on)

    def _check(self, are_on: Mapping[str, bool]) -> None:
        """Check these actions, or uncheck them, as they are on or not."""
        others = [name for name, is_on in are_on.items() if is_on != (name in self._on)]
        self._on = self._on.symmetric_difference(others)
        for name in sorted(others, key=self._on.__contains__):
            self._actions[name].setChecked(name in self._on)
        if others:
            self.switched.emit()

    def open_section(self, section: MenuSection) -> None:
        """Say of the actions of a section what is asked when their menu opens.

        It holds until actions are rendered for other facts or another curve.
        """
        state, session = self._facts.read(), self._facts.session
        if self._opened and self._opened_of is session.active_view:
            return
        self._opened_of = session.active_view
        for each in self._declared.values():
            if each.section is section and each.when_opened is not None and each.missing(state) is None:
                self._show_opened(each.name, each.when_opened(session))

    def _show_opened(self, name: str, opened: Opened) -> None:
        action = self._actions[name]
        action.setText(opened.text)
        action.setStatusTip(opened.tip)
        _enable(action, opened.why_not or None)
        self._opened.add(name)

    def _take_back_opened(self) -> None:
        """Say of actions again what they are declared with."""
        for name in self._opened:
            action, each = self._actions[name], self._declared[name]
            action.setText(each.text)
            action.setStatusTip(each.tip)
            _enable(action, *(self._missing.get(_needs_of(each)) or (None,)))
        self._opened.clear()

    def set_theme(self, theme: Theme) -> None:
        """Tint the icons for `theme`."""
        self._theme = theme
        for name, each in self._declared.items():
            if each.icon:
                self._actions[name].setIcon(icon(each.icon, theme))


def _needs_of(each: Action) -> tuple[Need, Need]:
    return each.section.needs, each.needs


def _why_not(needs: tuple[Need, Need], state: ActionState) -> tuple[str, bool] | None:
    """Return what is said of the first of some needs that is not met, and whether it is so already."""
    return next(((need.reason(state), need.is_so) for need in needs if not need.is_met(state)), None)


def _enable(action: QAction, why_not: str | None, is_so: bool = False) -> None:
    """Let an action be used, or not for a reason, which is empty for the usual sentence; None lets it."""
    say_reason(action, why_not or "", is_so=is_so)
    action.setEnabled(why_not is None)
    action.setToolTip(tool_tip(action))


@cache
def _sequences(keys: str) -> tuple[QKeySequence, ...]:
    return tuple(QKeySequence(part) for part in keys.split(", ")) if keys else ()


class KeyGate(SafeOverrides, QObject):
    """Lets the keys of actions pass, or says why not."""

    def __init__(self, facts: ActionFacts) -> None:
        super().__init__()
        self._facts = facts
        self._guarded: dict[str, Need] = {}

    def guard(self, action: QAction, needs: Need) -> None:
        """Let the keys of `action` pass only where `needs` is met."""
        self._guarded[action.objectName()] = needs
        action.installEventFilter(self)

    def release(self, action: QAction) -> None:
        """Guard the keys of `action` no longer; it has its name still."""
        if self._guarded.pop(action.objectName(), None) is not None:
            action.removeEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take a key that is refused."""
        if event.type() is not QEvent.Type.Shortcut:
            return False
        needs, state = self._guarded[watched.objectName()], self._facts.read()
        if needs.is_met(state):
            return False
        self._facts.session.refuse(needs.reason(state))
        return True
