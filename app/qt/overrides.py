"""Guarded overrides: an exception in a method that Qt calls is reported there, and the program goes on.

PySide6 hands an exception of an override on to whichever Python code called Qt last, if any did: that code
stops halfway, though nothing of it failed. Until Python 3.12 it even ends the process with a segmentation
fault where the exception was raised by C code (``1 / 0``, ``int("x")``, an index error of NumPy), because
shiboken reads one that was never normalised (`PepException_GetArgs`; PySide6 6.8 to 6.12). Slots do well
without: PySide6 prints their exceptions at once, through `sys.excepthook`.

Here are also the keys that a widget takes before its window does.
"""

from __future__ import annotations

import enum
import functools
import inspect
import sys
import traceback
from collections.abc import Callable
from contextlib import suppress
from types import FunctionType, MethodDescriptorType
from typing import Any, TypeVar, cast

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QLineEdit, QWidget

_Method = TypeVar("_Method", bound=Callable[..., object])


class SafeOverrides:
    """Mixin for classes derived from Qt's: every method that overrides one of Qt's is guarded.

    Named before Qt's class, ``class Canvas(SafeOverrides, QWidget)``, it guards the subclasses as well.
    Where an override fails, the exception goes to `sys.excepthook` and Qt gets an empty value of the type
    that the override declares to return. A window that failed to close stays open.
    """

    __slots__ = ()

    def __init_subclass__(cls, **options: Any) -> None:  # noqa: ANN401 - Qt's classes take options of any type
        super().__init_subclass__(**options)
        for name in overrides_of(cls):
            method = vars(cls)[name]
            if not is_guarded(method):
                setattr(cls, name, guard(method))


def overrides_of(cls: type) -> list[str]:
    """Return the names of the methods in the body of `cls` that override methods of Qt's classes."""
    of_qt = [vars(base) for base in cls.__mro__ if base.__module__.startswith("PySide6.")]
    return [
        name
        for name, value in vars(cls).items()
        if isinstance(value, FunctionType)
        and not name.startswith("__")
        and any(isinstance(members.get(name), MethodDescriptorType) for members in of_qt)
    ]


def is_guarded(method: Callable[..., object]) -> bool:
    """Return whether exceptions of this method end in it."""
    return bool(getattr(method, "_guards", False))


def guard_library(*classes: type) -> None:
    """Guard the overrides of these classes of a library and of those that they derive from.

    Events and painting are guarded as those of the program. Other overrides declare no type and may rely on
    their exceptions: these are passed on, but normalised.
    """
    for cls in {base for given in classes for base in given.__mro__}:
        for name in overrides_of(cls):
            method = vars(cls)[name]
            if not hasattr(method, "_guards"):
                gives_nothing = name == "paint" or name.endswith("Event")
                setattr(cls, name, guard(method) if gives_nothing else _normalise(method))


def _normalise(method: FunctionType) -> Callable[..., object]:
    @functools.wraps(method)
    def normalised(*arguments: object, **named: object) -> object:
        try:
            return method(*arguments, **named)
        except BaseException:
            raise  # normalised by having been caught

    vars(normalised)["_guards"] = False
    return normalised


def guard(method: _Method) -> _Method:
    """Return `method` with a guard around it; ``__wrapped__`` is the bare one.

    For methods of a mixin, which does not derive from a class of Qt.
    """

    @functools.wraps(method)
    def guarded(*arguments: object) -> object:
        try:
            return method(*arguments)
        except Exception as problem:
            report(problem)
            _keep_open(arguments)
            return empty_result(method)
        except BaseException:
            raise  # normalised by having been caught

    vars(guarded)["_guards"] = True
    return cast("_Method", guarded)


def report(problem: Exception) -> None:
    """Report an exception that ends here as an uncaught one."""
    with suppress(Exception):
        sys.excepthook(type(problem), problem, problem.__traceback__)
    # A painter that the method left open must end before Qt goes on with its device.
    traceback.clear_frames(problem.__traceback__)


def _keep_open(arguments: tuple[object, ...]) -> None:
    """Refuse a close event among the arguments: the user has not been asked about unsaved changes yet."""
    for argument in arguments:
        if isinstance(argument, QEvent) and argument.type() == QEvent.Type.Close:
            argument.ignore()


def empty_result(method: Callable[..., object]) -> Any:  # noqa: ANN401 - whatever the override declares
    """Return the result of a failed override for Qt: zero, false, an empty value, or no object."""
    declared = method.__annotations__.get("return")
    kind = eval(str(declared), inspect.unwrap(method).__globals__)
    if kind in (None, Any, object):
        return None
    if isinstance(kind, enum.EnumType):
        return kind(0)
    # Values of Qt can be copied; for anything else Qt gets the null pointer.
    is_pointer = kind.__module__.startswith("PySide6.") and not hasattr(kind, "__copy__")
    return None if is_pointer else kind()


def application() -> QApplication:
    """Return the running application."""
    running = QApplication.instance()
    assert isinstance(running, QApplication)
    return running


ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
DELETE = (Qt.Key.Key_Delete, Qt.Key.Key_Backspace)

PASSING = (Qt.FocusReason.ActiveWindowFocusReason, Qt.FocusReason.PopupFocusReason)
"""Reasons of a temporary loss of focus: another window, or the field's own menu."""


class ClaimsKeys(SafeOverrides):
    """Mixin for widgets, named before Qt's class: keys that `claims` accepts do not go to the window."""

    def claims(self, event: QKeyEvent) -> bool:
        """Return whether the widget handles a key."""
        raise NotImplementedError

    @guard
    def event(self, event: QEvent) -> bool:
        """Claim a key; called by Qt."""
        is_claim = event.type() == QEvent.Type.ShortcutOverride
        if is_claim and isinstance(event, QKeyEvent) and self.claims(event):
            event.accept()
            return True
        return bool(super().event(event))  # type: ignore[misc]  # that of the widget's class


_TEXT_KEYS = frozenset(map(Qt.Key, map(ord, "ACVXYZ")))
"""Letters that edit text with Ctrl, and belong to the field."""

_SHIFT, _CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier


class FieldShortcuts(SafeOverrides, QObject):
    """Lets shortcuts of Ctrl and a letter act while a field of the window has the focus.

    On X11 Qt's fields claim some of these, such as Ctrl+E for the end of the line. Without a shortcut for
    the keys they keep that meaning.
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        application().focusChanged.connect(self._watch)

    def _watch(self, _old: QWidget | None, new: QWidget | None) -> None:
        if isinstance(new, QLineEdit | QAbstractSpinBox):
            new.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep a field from claiming a key that does not edit text."""
        if event.type() != QEvent.Type.ShortcutOverride or not isinstance(event, QKeyEvent):
            return False
        key, is_ctrl = event.key(), event.modifiers() & ~_SHIFT == _CTRL
        if not is_ctrl or not Qt.Key.Key_A <= key <= Qt.Key.Key_Z or key in _TEXT_KEYS:
            return False
        event.ignore()
        return True
