"""The QActions of a window, made from the declarations of its command sets."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QWidget

from ..appearance.icons import icon
from ..appearance.theme import Theme
from ..document.paper import kind_of
from ..view_model.curve.curve_view import CurveView
from .declaration import Action, Declared, Sight, all_declared
from .key_gate import KeyGate
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
from .needs import NOTHING, Need
from .sections import MENUS, Menu, Section
from .situation import Situation
from .strips import BARS, Bar, Place, Strip

_Run = Callable[[Action, Callable[[], object], bool], object]


_USABLE = True, ""


class _Alike:
    """Actions that need the same: they can be used, or cannot for one reason, together.

    Parameters
    ----------
    first
        The declaration of any of them.
    """

    def __init__(self, first: Action) -> None:
        self._first = first
        self._told: tuple[bool, str] | None = None
        self.actions: list[QAction] = []

    def render(self, now: Situation, is_met: Callable[[Need], bool]) -> None:
        """Enable or disable them, where that is news."""
        missing = self._first.missing(is_met)
        told = _USABLE if missing is None else (False, missing.reason(now))
        is_so = missing is not None and missing.is_so
        if told != self._told:
            self._told = told
            for action in self.actions:
                say_reason(action, told[1], is_so=is_so)
                action.setEnabled(told[0])
                action.setToolTip(tool_tip(action))


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

    def __init__(self, window: QWidget, command_sets: Sequence[type], now: Situation) -> None:
        super().__init__()
        self.keymap = Keymap(window)
        self._window = self._hearer = window
        self._now = now
        self._gate = KeyGate(now)
        self._command_sets = command_sets
        self._bound: dict[type, tuple[object, _Run]] = {}
        self._theme: Theme | None = None
        self._groups: dict[str, QActionGroup] = {}
        self._handlers = all_declared(command_sets)
        self._declared = {each.action.name: each.action for each in self._handlers}
        self._actions = {name: self._make(each) for name, each in self._declared.items()}
        self._sort_out()
        self._on = set[str]()
        self._bars: tuple[Bar, ...] = ()
        self._seen: dict[str, Sight] = {}
        self._seen_of: CurveView | None = None

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
        in_drawings = None if each.drawing_key is None else _sequences(each.drawing_key)
        self.keymap.add(Binding(action, name, each.section.menu.title, _sequences(each.key), in_drawings))
        if each.key_needs is not NOTHING or each.key_asks is not None:
            self._gate.guard(action, each.key_needs, each.key_asks)
        return action

    def _sort_out(self) -> None:
        """Find what has to be asked about each: all the time, so nobody looks through hundreds for it."""
        declared = [(each, self._actions[name]) for name, each in self._declared.items()]
        self._switches = [(each, action) for each, action in declared if each.checked is not None]
        self._titled = [(each.title, action) for each, action in declared if each.title is not None]
        self._alike = self._find_alike()

    def _find_alike(self) -> list[_Alike]:
        found: dict[tuple[int, int], _Alike] = {}
        for name, each in self._declared.items():
            needs = id(each.section.needs), id(each.needs)
            found.setdefault(needs, _Alike(each)).actions.append(self._actions[name])
        return list(found.values())

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
        self._seen.pop(name, None)
        self.keymap.remove(name)
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

    def in_section(self, section: Section) -> list[QAction]:
        """Return the actions of a section of a menu, in order."""
        return [self._actions[name] for name, each in self._declared.items() if each.section is section]

    def in_strip(self, strip: Strip) -> dict[int, list[QAction]]:
        """Return the actions of a strip by the tens of their places, in order."""
        groups = self.with_sections(strip).items()
        return {ten: [each for each in group if isinstance(each, QAction)] for ten, group in groups}

    def choices_of(self, action: QAction) -> Strip | None:
        """Return the strip of switches that the button of an action offers; None where it has none."""
        declared = self._declared.get(action.objectName())
        return declared.choices if declared is not None else None

    def with_sections(self, strip: Strip) -> dict[int, list[QAction | Section]]:
        """Return the actions of a strip, and the sections that are submenus there, by their tens."""
        places: list[tuple[Place, QAction | Section]]
        places = [(place, self[each.action.name]) for each in self._handlers for place in each.places]
        places += [(place, each) for menu in MENUS for each in menu.sections for place in each.also]
        found: dict[int, list[QAction | Section]] = {}
        for place, entry in sorted(places, key=lambda pair: pair[0].number):
            if place.strip is strip:
                found.setdefault(place.number // 10, []).append(entry)
        return found

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
        declared = self._declared.get(name)
        return declared is not None and declared.is_on(self._now)

    def is_shown(self, bar: Bar) -> bool:
        """Whether a bar of the toolbar is the one to work with now."""
        return bar.is_shown(self._now)

    def follow(self) -> None:
        """Render, when all is told of which there is news."""
        self._now.session.telling.then(self.render)

    def render(self) -> None:
        """Enable, check and name all actions as the situation has it."""
        now = self._now
        self.keymap.use(kind_of(now.session.document))
        is_met = _remembering(now)
        for alike in self._alike:
            alike.render(now, is_met)
        self._check(is_met)
        for title, action in self._titled:
            action.setText(title(now))
        if now.view is not self._seen_of:
            for name in self._seen:
                self._show(name, Sight(self._declared[name].text, self._declared[name].tip))
            self._seen.clear()
        for name, sight in self._seen.items():
            self._show(name, sight)

    def take_back_click(self, name: str) -> None:
        """Let a switch that was clicked, and those that went off with it, show what is on."""
        # It may be there no more: its record went with what it did.
        declared = self._declared.get(name)
        if declared is not None and declared.checked is not None:
            self._check(_remembering(self._now))

    def _check(self, is_met: Callable[[Need], bool]) -> None:
        now, on = self._now, set[str]()
        for each, action in self._switches:
            is_on = each.is_on(now, is_met)
            action.setChecked(is_on)
            if is_on:
                on.add(each.name)
        bars = tuple(bar for bar in BARS if bar.is_shown(now))
        if (on, bars) != (self._on, self._bars):
            self._on, self._bars = on, bars
            self.switched.emit()

    def look(self) -> None:
        """Find out about the actions that tell more when somebody looks at them: a menu or the palette opens.

        It holds while the active curve stays what it is.
        """
        self._seen_of = self._now.view
        for name, each in self._declared.items():
            if each.on_sight is None or name in self._seen:
                continue
            if each.missing(lambda need: need.is_met(self._now)) is None:
                self._seen[name] = each.on_sight(self._now)
                self._show(name, self._seen[name])

    def _show(self, name: str, sight: Sight) -> None:
        action = self._actions[name]
        action.setText(sight.text)
        action.setStatusTip(sight.tip)
        missing = self._declared[name].missing(lambda need: need.is_met(self._now))
        action.setEnabled(missing is None and not sight.why_not)
        say_reason(action, missing.reason(self._now) if missing is not None else sight.why_not)
        action.setToolTip(tool_tip(action))

    def set_theme(self, theme: Theme) -> None:
        """Tint the icons for `theme`."""
        self._theme = theme
        for name, each in self._declared.items():
            if each.icon:
                self._actions[name].setIcon(icon(each.icon, theme))


def _remembering(now: Situation) -> Callable[[Need], bool]:
    """Return what tells whether a need is met now, each asked once."""
    met: dict[int, bool] = {}

    def is_met(need: Need) -> bool:
        try:
            return met[id(need)]
        except KeyError:
            found = met[id(need)] = need.is_met(now)
            return found

    return is_met


@cache
def _sequences(keys: str) -> tuple[QKeySequence, ...]:
    return tuple(QKeySequence(part) for part in keys.split(", ")) if keys else ()
