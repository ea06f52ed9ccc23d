"""Actions are declared where they are handled.

A decorator on the method of a command set says everything about an action::

    @action("newSeed", "New Seed", OVERLAYS_ERRORS, icon="seed")
    def _new_seed(self) -> None:
        '''Draw other random errors.'''

    @action_for_each(OVERLAYS, lambda each: Action(f"overlay{each.title}", …))
    def _switch(self, overlay: Overlay) -> None:
        …

    @switch("rulers", "toggleRulers", "Rulers", VIEW_DRAWING)  # a field of the window's state
    def _toggle_rulers(self) -> None:
        '''Show rulers above the canvas and at its left.'''

What an action does is said by the docstring of its handler: it is the action's tip.
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

_DECLARED, _AT_PLACE = "declared_actions", "place_action"
_ALSO, _WIDGET = "positions_in_bars", "widget_in_bar"

_Handler = TypeVar("_Handler", bound=Callable[..., object])
_Record = TypeVar("_Record")
_Fields = ParamSpec("_Fields")


class Opened(msgspec.Struct, frozen=True):
    """Words and state of an action in a menu that opens.

    Attributes
    ----------
    text, tip
        Its text, and what it does.
    why_not
        The reason why it cannot be used, as a sentence; empty where it can.
    """

    text: str
    tip: str
    why_not: str = ""


class Action(msgspec.Struct, frozen=True):
    """Description of an action: its name, how it is reached, where it stands and what it needs.

    Attributes
    ----------
    name
        The QAction's objectName.
    text
        Menu text, without mnemonic.
    section
        Where in the menus it stands.
    key
        One or more key sequences, comma separated; empty for none.
    icon
        A file of resources/icons, without suffix; empty for none.
    tip
        What it does, for tooltip and status line; where empty, the first line of the handler's docstring.
    full_name
        What it is called where its menu is not seen: in the palette and the list of keys; the text itself
        where empty.
    needs
        What must be there before it can be used.
    key_needs
        What its keys need besides, where a slip of the finger would do more than a click means.
    checked
        Whether it is on; makes it a switch.
    field
        The field of the window's state that it turns on and off; empty for none.
    choices
        The bar of switches that the arrow beside its button in the toolbar offers; None for no arrow.
    group
        Name of the group of which one is on; empty for a switch of its own.
    title
        Its text where that changes.
    when_opened
        What is found out of the session only when the menu of the action opens.
    short
        What a button says of it beside its icon where there is little room; else it has its icon alone.
    during_gesture
        Whether it leaves a gesture in flight alone, in a menu whose actions interrupt.
    keywords
        Words by which the palette finds it, too, beside those of its name and tip.
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
    when_opened: Callable[[Session], Opened] | None = None
    field: str = ""
    choices: ActionBar | None = None

    def missing(self, state: ActionState) -> Need | None:
        """Return the first of its needs that is not met, those of its section before its own."""
        return next((needs for needs in (self.section.needs, self.needs) if not needs.is_met(state)), None)

    def is_on(self, state: ActionState) -> bool:
        """Whether what it switches is on: of nothing, nothing is."""
        return self.checked is not None and self.section.needs.is_met(state) and self.checked(state)

    @property
    def interrupts(self) -> bool:
        """Whether a gesture in flight is taken back before it begins."""
        return self.section.menu.interrupts and not self.during_gesture


class Declared(msgspec.Struct, frozen=True):
    """An action, and the handler on which it was declared.

    Attributes
    ----------
    commands
        The command set of the handler.
    handler
        Called with an instance of that, and with the record that the action stands for, if any.
    """

    action: Action
    commands: type
    handler: Callable[..., object]
    record: tuple[object, ...] = ()

    @property
    def places(self) -> tuple[BarPosition, ...]:
        """Places of the action besides its menu."""
        places = getattr(self.handler, _ALSO, ())
        return tuple(places(*self.record)) if callable(places) else places

    def bound_to(self, commands: object) -> Callable[[], object]:
        """Return what the action does, for one command set."""
        return partial(self.handler, commands, *self.record)


class Decorator:
    """Declares the method that it is put on as the handler of actions."""

    def __init__(self, described: Callable[[], Iterable[tuple[Action, tuple[object, ...]]]]) -> None:
        self._described = described

    def __call__(self, handler: _Handler) -> _Handler:
        """Declare `handler`, and leave it as it is."""
        setattr(handler, _DECLARED, self._described)
        return handler


def _decorator_of(make: Callable[_Fields, Action]) -> Callable[_Fields, Decorator]:
    def declare(*fields: _Fields.args, **more: _Fields.kwargs) -> Decorator:
        described = make(*fields, **more)
        return Decorator(lambda: [(described, ())])

    return declare


action = _decorator_of(Action)
"""Declare the decorated method as the handler of an action; takes the fields of `Action`."""


def _switch_of(make: Callable[_Fields, Action]) -> Callable[Concatenate[str, _Fields], Decorator]:
    def declare(field: str, /, *fields: _Fields.args, **more: _Fields.kwargs) -> Decorator:
        assert hasattr(WindowState, field), field
        described = replace(
            make(*fields, **more), field=field, checked=lambda state: bool(getattr(state.window, field))
        )
        return Decorator(lambda: [(described, ())])

    return declare


switch = _switch_of(Action)
"""Declare an action that turns a field of the window's state on and off; takes that, and those of `Action`.

The decorated method does what comes after that, often nothing: then it has a docstring, which is the tip.
"""


def also(*places: BarPosition) -> Callable[[_Handler], _Handler]:
    """Let the actions of the decorated handler stand in bars, too: toolbar, context menus, buttons."""
    return _also(places)


def also_for_each(places: Callable[[Any], Iterable[BarPosition]]) -> Callable[[_Handler], _Handler]:
    """Let each action of the decorated handler stand where `places` says of its record."""
    return _also(places)


def widget_at(place: BarPosition) -> Callable[[_Handler], _Handler]:
    """Let what the decorated method returns stand in a bar."""

    def mark(build: _Handler) -> _Handler:
        setattr(build, _WIDGET, place)
        return build

    return mark


def declared_widgets(kind: type, commands: object) -> Iterator[tuple[BarPosition, Any]]:
    """Yield what a command set puts into bars besides actions, with its place."""
    for build, place in marked(kind, _WIDGET):
        yield place, build(commands)


def _also(places: object) -> Callable[[_Handler], _Handler]:

    def mark(handler: _Handler) -> _Handler:
        setattr(handler, _ALSO, places)
        return handler

    return mark


def action_for_each(
    records: Iterable[_Record] | Callable[[], Iterable[_Record]], describe: Callable[[_Record], Action]
) -> Decorator:
    """Declare the decorated method as the handler of one action for each record, which it is called with.

    There may be more records by the time that a window is made.
    """
    return Decorator(
        lambda: [(describe(each), (each,)) for each in (records() if callable(records) else records)]
    )


class PlaceAction(msgspec.Struct, frozen=True):
    """Declares the method that it is put on as what an entry of the menu for a place on the curve does.

    The method takes the parameter t there.

    Attributes
    ----------
    name, text
        The entry's objectName and text.
    like
        The action that does it elsewhere: its icon, tip and needs are the entry's.
    """

    name: str
    text: str
    like: str

    def __call__(self, handler: _Handler) -> _Handler:
        """Declare `handler`, and leave it as it is."""
        setattr(handler, _AT_PLACE, self)
        return handler


def place_actions(kind: type, commands: object) -> Iterator[tuple[PlaceAction, Callable[[float], object]]]:
    """Yield the entries that a command set declares for the menu of a place, with what they do."""
    for member, entry in marked(kind, _AT_PLACE):
        yield entry, partial(member, commands)


@cache
def marked(commands: type, mark: str) -> tuple[tuple[Callable[..., Any], Any], ...]:
    """Return the methods of a class that have an attribute `mark`, in order, with its value."""
    found = ((member, getattr(member, mark, None)) for member in vars(commands).values())
    return tuple((member, value) for member, value in found if value is not None)


def all_declared(command_sets: Iterable[type]) -> list[Declared]:
    """Return the actions of some command sets, in the order of the menus."""
    found = [each for commands in command_sets for each in _declared_by(commands)]
    return sorted(found, key=lambda each: each.action.section.place)


def _declared_by(commands: type) -> Iterator[Declared]:
    for handler, described in marked(commands, _DECLARED):
        tip = (handler.__doc__ or "").strip().partition("\n")[0].removesuffix(".")
        for each, record in described():
            yield Declared(each if each.tip else replace(each, tip=tip), commands, handler, record)
