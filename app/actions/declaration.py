"""Actions are declared where they are handled.

A decorator on the method of a command set says everything about an action::

    @action("newSeed", "New Seed", OVERLAYS_ERRORS, icon="seed")
    def _new_seed(self) -> None:
        '''Draw new random errors.'''

    @action_for_each(OVERLAYS, lambda overlay: Action(f"overlay{overlay.title}", …))
    def _switch(self, overlay: Overlay) -> None:
        …

    @switch("rulers", "toggleRulers", "Rulers", VIEW_DRAWING)  # a field of the window's state
    def _toggle_rulers(self) -> None:
        '''Show rulers above the canvas and at its left.'''

The first line of the handler's docstring is the tip of the action.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cache, partial
from typing import Any, Concatenate, ParamSpec, TypeVar

import msgspec
from msgspec.structs import replace

from ..session import Session
from ..state.window_state import WindowState
from .menus import ActionBar, BarPosition, MenuSection
from .needs import NOTHING, Need
from .state import ActionState

_DECLARED, _AT_POSITION = "declared_actions", "position_action"
_ALSO, _WIDGET = "positions_in_bars", "widget_in_bar"

_Handler = TypeVar("_Handler", bound=Callable[..., object])
_Record = TypeVar("_Record")
_Fields = ParamSpec("_Fields")


class OpenedEntry(msgspec.Struct, frozen=True):
    """Text, tip and state of an action in a menu that opens.

    Attributes
    ----------
    text, tip
        Text of the entry, and its tip.
    reason
        Sentence why the action cannot be used; empty where it can.
    """

    text: str
    tip: str
    reason: str = ""


class Action(msgspec.Struct, frozen=True):
    """Description of an action: its name and texts, its place in the menus, its keys and its condition.

    A handler declares one with the decorator `action`, which takes these fields.

    Attributes
    ----------
    name
        The QAction's objectName.
    text
        Menu text, without mnemonic.
    section
        The section of the menu that lists the action.
    key
        One or more key sequences, comma separated; empty for none.
    icon
        A file of resources/icons, without suffix; empty for none.
    tip
        Tip for tooltip and status line; by default the first line of the handler's docstring.
    full_name
        Name where the menu is not visible: in the command palette and the list of keys; by default the text.
    needs
        Condition under which the action can be used.
    key_needs
        Further condition of its keys, for actions that must not run by a slip of the finger.
    checked
        Predicate that tells whether the action is on; makes it a switch.
    field
        Field of the window's state that the action turns on and off; empty for none.
    choices
        Bar of switches in the menu of its toolbar button; None for a button without a menu.
    group
        Name of a group of switches of which exactly one is on; empty for an independent switch.
    title
        Function that returns the text, where it changes.
    when_opened
        Function that asks the session for text and state when the menu of the action opens.
    short
        Text of its toolbar button where room is short; without one the button has an icon alone.
    during_gesture
        Whether the action keeps a gesture in flight, in a menu whose actions interrupt.
    keywords
        Further words by which the command palette finds the action.
    """

    name: str
    text: str
    section: MenuSection
    key: str = ""
    icon: str = ""
    tip: str = ""
    full_name: str = ""
    needs: Need = NOTHING
    key_needs: Need = NOTHING
    checked: Callable[[ActionState], bool] | None = None
    group: str = ""
    title: Callable[[ActionState], str] | None = None
    short: str = ""
    during_gesture: bool = False
    keywords: str = ""
    when_opened: Callable[[Session], OpenedEntry] | None = None
    field: str = ""
    choices: ActionBar | None = None

    def missing(self, state: ActionState) -> Need | None:
        """Return the first condition that is not met, of its section or its own; None where all are met."""
        return next((needs for needs in (self.section.needs, self.needs) if not needs.is_met(state)), None)

    def is_on(self, state: ActionState) -> bool:
        """Return whether the switch is on; never without the curve that its section needs."""
        return self.checked is not None and self.section.needs.is_met(state) and self.checked(state)

    @property
    def interrupts(self) -> bool:
        """Whether a gesture in flight is cancelled before the action runs."""
        return self.section.menu.interrupts and not self.during_gesture


class Declared(msgspec.Struct, frozen=True):
    """Action with the handler on which it was declared.

    Attributes
    ----------
    commands
        The command set of the handler.
    handler
        Method of the command set; it gets the record that the action stands for, if there is one.
    """

    action: Action
    commands: type
    handler: Callable[..., object]
    record: tuple[object, ...] = ()

    @property
    def positions(self) -> tuple[BarPosition, ...]:
        """Positions of the action in bars."""
        positions = getattr(self.handler, _ALSO, ())
        return tuple(positions(*self.record)) if callable(positions) else positions

    def bound_to(self, commands: object) -> Callable[[], object]:
        """Return the handler bound to a command set and to its record."""
        return partial(self.handler, commands, *self.record)


class Decorator:
    """Decorator that declares a method as the handler of actions."""

    def __init__(self, described: Callable[[], Iterable[tuple[Action, tuple[object, ...]]]]) -> None:
        self._described = described

    def __call__(self, handler: _Handler) -> _Handler:
        """Declare `handler` and return it unchanged."""
        setattr(handler, _DECLARED, self._described)
        return handler


def _decorator_of(make: Callable[_Fields, Action]) -> Callable[_Fields, Decorator]:
    def declare(*fields: _Fields.args, **more: _Fields.kwargs) -> Decorator:
        described = make(*fields, **more)
        return Decorator(lambda: [(described, ())])

    return declare


action = _decorator_of(Action)
"""Decorator that declares a method as the handler of an action; takes the fields of `Action`."""


def _switch_of(make: Callable[_Fields, Action]) -> Callable[Concatenate[str, _Fields], Decorator]:
    def declare(field: str, /, *fields: _Fields.args, **more: _Fields.kwargs) -> Decorator:
        assert hasattr(WindowState, field), field
        described = replace(
            make(*fields, **more), field=field, checked=lambda state: bool(getattr(state.window, field))
        )
        return Decorator(lambda: [(described, ())])

    return declare


switch = _switch_of(Action)
"""Decorator of an action that turns a field of `WindowState` on and off; takes it and the fields of `Action`.

The decorated method runs afterwards. Often it has only a docstring, which is the tip.
"""


def also(*positions: BarPosition) -> Callable[[_Handler], _Handler]:
    """Place the actions of the decorated handler in bars as well: toolbar, context menus, buttons."""
    return _marking(_ALSO, positions)


def also_for_each(positions: Callable[[Any], Iterable[BarPosition]]) -> Callable[[_Handler], _Handler]:
    """Place each action of the decorated handler at the positions that `positions` returns for its record."""
    return _marking(_ALSO, positions)


def widget_at(position: BarPosition) -> Callable[[_Handler], _Handler]:
    """Place the widget that the decorated method returns in a bar."""
    return _marking(_WIDGET, position)


def declared_widgets(kind: type, commands: object) -> Iterator[tuple[BarPosition, Any]]:
    """Yield the widgets that a command set adds to bars, with their positions."""
    for build, position in marked(kind, _WIDGET):
        yield position, build(commands)


def _marking(name: str, value: object) -> Callable[[_Handler], _Handler]:
    """Return a decorator that gives a method an attribute."""

    def mark(handler: _Handler) -> _Handler:
        setattr(handler, name, value)
        return handler

    return mark


def action_for_each(
    records: Iterable[_Record] | Callable[[], Iterable[_Record]], describe: Callable[[_Record], Action]
) -> Decorator:
    """Declare the decorated method as the handler of one action per record; it is called with the record.

    `records` may be a function, for records that are registered later.
    """
    return Decorator(
        lambda: [(describe(record), (record,)) for record in (records() if callable(records) else records)]
    )


class PositionAction(msgspec.Struct, frozen=True):
    """Decorator that adds a method to the context menu of a position on the curve.

    The method takes the parameter t of the position.

    Attributes
    ----------
    name, text
        The objectName and the text of the entry.
    like
        The action with the same effect elsewhere; it lends the entry its icon, tip and state.
    """

    name: str
    text: str
    like: str

    def __call__(self, handler: _Handler) -> _Handler:
        """Declare `handler` and return it unchanged."""
        setattr(handler, _AT_POSITION, self)
        return handler


def position_actions(
    kind: type, commands: object
) -> Iterator[tuple[PositionAction, Callable[[float], object]]]:
    """Yield the entries that a command set declares for the menu of a position, with their handlers."""
    for member, entry in marked(kind, _AT_POSITION):
        yield entry, partial(member, commands)


@cache
def marked(commands: type, mark: str) -> tuple[tuple[Callable[..., Any], Any], ...]:
    """Return the methods of a class that have the attribute `mark`, in order, with its value."""
    methods = ((member, getattr(member, mark, None)) for member in vars(commands).values())
    return tuple((member, value) for member, value in methods if value is not None)


def all_declared(command_sets: Iterable[type]) -> list[Declared]:
    """Return the actions of some command sets, in the order of the menus."""
    declared = [action for commands in command_sets for action in _declared_by(commands)]
    return sorted(declared, key=lambda action: action.action.section.rank)


def _declared_by(commands: type) -> Iterator[Declared]:
    for handler, described in marked(commands, _DECLARED):
        tip = (handler.__doc__ or "").strip().partition("\n")[0].removesuffix(".")
        for action, record in described():
            yield Declared(action if action.tip else replace(action, tip=tip), commands, handler, record)
