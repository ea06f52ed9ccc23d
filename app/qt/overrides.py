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

    It is named before Qt's class, ``class Canvas(SafeOverrides, QWidget)``, and serves the subclasses too.
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
    """Return the names of the methods in the body of `cls` that Qt's classes have too."""
    of_qt = [vars(base) for base in cls.__mro__ if base.__module__.startswith("PySide6.")]
    return [
        name
        for name, value in vars(cls).items()
        if isinstance(value, FunctionType)
        and not name.startswith("__")
        and any(isinstance(each.get(name), MethodDescriptorType) for each in of_qt)
    ]


def is_guarded(method: Callable[..., object]) -> bool:
    """Return whether an exception of this method ends in it."""
    return bool(getattr(method, "_guards", False))


def guard_library(*classes: type) -> None:
    """Guard the overrides of these classes of a library and of those that they derive from.

    Events and painting are guarded as ours are. The others declare no type and may count on what an
    exception of theirs stops: it is handed on, as before, but normalised.
    """
    for cls in {base for each in classes for base in each.__mro__}:
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

    For methods of a mixin, which has no class of Qt's to override.
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
    """Tell of an exception that ends here, as of one that nobody caught."""
    with suppress(Exception):
        sys.excepthook(type(problem), problem, problem.__traceback__)
    # A painter that the method left open must end before Qt goes on with what it paints on.
    traceback.clear_frames(problem.__traceback__)


def _keep_open(arguments: tuple[object, ...]) -> None:
    """Refuse a request to close among the arguments of an override: nobody has been asked yet."""
    for each in arguments:
        if isinstance(each, QEvent) and each.type() == QEvent.Type.Close:
            each.ignore()


def empty_result(method: Callable[..., object]) -> Any:  # noqa: ANN401 - whatever the override declares
    """Return what Qt gets from an override that failed: zero, false, an empty value, or no object."""
    declared = method.__annotations__.get("return")
    kind = eval(str(declared), inspect.unwrap(method).__globals__)
    if kind in (None, Any, object):
        return None
    if isinstance(kind, enum.EnumType):
        return kind(0)
    # What Qt passes by value can be copied; of anything else it gets the null pointer.
    is_pointer = kind.__module__.startswith("PySide6.") and not hasattr(kind, "__copy__")
    return None if is_pointer else kind()


ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
DELETE = (Qt.Key.Key_Delete, Qt.Key.Key_Backspace)

PASSING = (Qt.FocusReason.ActiveWindowFocusReason, Qt.FocusReason.PopupFocusReason)
"""Ways to lose the focus of somebody who comes back to go on typing: another window, the field's own menu."""


class ClaimsKeys(SafeOverrides):
    """Mixin for widgets, named before Qt's class: keys that `claims` knows do not go to the window."""

    def claims(self, event: QKeyEvent) -> bool:
        """Whether a key is the widget's."""
        raise NotImplementedError

    @guard
    def event(self, event: QEvent) -> bool:
        """Claim a key; called by Qt."""
        is_asked = event.type() == QEvent.Type.ShortcutOverride
        if is_asked and isinstance(event, QKeyEvent) and self.claims(event):
            event.accept()
            return True
        return bool(super().event(event))  # type: ignore[misc]  # that of the widget's class


_OF_TEXT = frozenset(map(Qt.Key, map(ord, "ACVXYZ")))
"""Letters that edit text with Ctrl: the field's own."""

_SHIFT, _CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier


class FieldShortcuts(SafeOverrides, QObject):
    """Lets the shortcuts of a window act while one of its fields has the focus: Ctrl and a letter.

    On X11 Qt's fields claim some of these, Ctrl+E for the end of the line. Where no shortcut has the keys
    they still mean that.
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._watch)

    def _watch(self, _old: QWidget | None, new: QWidget | None) -> None:
        if isinstance(new, QLineEdit | QAbstractSpinBox):
            new.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep a field from claiming a key that is no text editing."""
        if event.type() != QEvent.Type.ShortcutOverride or not isinstance(event, QKeyEvent):
            return False
        key, is_ctrl = event.key(), event.modifiers() & ~_SHIFT == _CTRL
        if not is_ctrl or not Qt.Key.Key_A <= key <= Qt.Key.Key_Z or key in _OF_TEXT:
            return False
        event.ignore()
        return True
