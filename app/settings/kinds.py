"""Kinds of settings: conversion of the text in the file to a value, and back.

A setting is an attribute of a class that has a `SettingsFile`::

    class Preferences:
        snap_on = Switch("snap/on", default=False)

Reading it never raises because of what is in the file: a value that cannot be used is complained about, and
the default counts.

`Choice`, `Several`, `Distance` and `Text` have a label: they stand in the dialog of preferences, in the order
of the class; those of tools follow. The other kinds remember what a person does elsewhere.
"""

from __future__ import annotations

import json
import math
import os
import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Mapping, Sequence
from enum import Enum
from pathlib import Path
from typing import Any, Final, Generic, Protocol, TypeVar, overload

import msgspec
from PySide6.QtCore import QByteArray

from ..document.model import Curve, Document, empty_document
from ..document.style import PLAIN_STYLE, Style
from ..document.words import enumerated
from ..storage.format import decode, encode
from ..storage.format_error import FormatError
from ..storage.validation import check_fields
from .file import SettingsFile

Value = TypeVar("Value")
Member = TypeVar("Member", bound=Enum)

_SWITCHES: Final = ("off", "on")
_LEAST_SPACING, _GREATEST_SPACING = 1e-9, 1e9


class Remembering(Protocol):
    """Object with settings."""

    @property
    def file(self) -> SettingsFile:
        """The file of the settings."""


class _UnusableError(ValueError):
    """Error for a text that is no value of a setting, with the reason."""


class Setting(ABC, Generic[Value]):
    """Descriptor of one setting, saved under `key`.

    Attributes
    ----------
    label, tip
        Texts in the dialog of preferences; a setting without a label is not shown there.
    widget
        The objectName of its widget there; that of one of several has the member in place of the braces.
    """

    def __init__(self, key: str, label: str = "", tip: str = "", widget: str = "") -> None:
        self.key, self.label, self.tip, self.widget = key, label, tip, widget

    def __set_name__(self, _owner: type, name: str) -> None:
        self.widget = self.widget or f"preference_{name}"

    @overload
    def __get__(self, owner: None, kind: type) -> Setting[Value]: ...
    @overload
    def __get__(self, owner: Remembering, kind: type) -> Value: ...
    def __get__(self, owner: Remembering | None, kind: type) -> Setting[Value] | Value:
        return self if owner is None else self._read(owner.file)

    def __set__(self, owner: Remembering, value: Value) -> None:
        self.write(owner.file, value)

    def read(self, file: SettingsFile) -> Value:
        """Return the value in the file, or the default."""
        return self._read(file)

    def write(self, file: SettingsFile, value: Value) -> None:
        """Have the file hold a value."""
        file.write(self.key, self._stored(value))

    @abstractmethod
    def _read(self, file: SettingsFile) -> Value:
        """Return the value of the file, or the default."""

    def _stored(self, value: Value) -> object:
        """Return the representation of a value in the file."""
        return value


class TextSetting(Setting[Value]):
    """Setting that is text in the file; empty text counts as not set."""

    def __init__(self, key: str, default: Value, label: str = "", tip: str = "", widget: str = "") -> None:
        super().__init__(key, label, tip, widget)
        self.default = default

    def _read(self, file: SettingsFile) -> Value:
        text = file.text(self.key)
        if not text:
            return self.default
        try:
            return self._parse(text)
        except _UnusableError as reason:
            file.complain(self.key, str(reason))
            return self.default

    @abstractmethod
    def _parse(self, text: str) -> Value:
        """Return the value of a text, or raise `_UnusableError`."""


class Choice(TextSetting[Member]):
    """Member of an enumeration with words as values and labels."""

    def _parse(self, text: str) -> Member:
        kind = type(self.default)
        try:
            return kind(text)
        except ValueError:
            known = enumerated([member.value for member in kind])
            raise _UnusableError(f"“{text}” is not one of {known}") from None

    def _stored(self, value: Member) -> object:
        return value.value


class Switch(TextSetting[bool]):
    """Boolean that an action or a check box turns on and off."""

    def __init__(self, key: str, *, default: bool, label: str = "", tip: str = "", widget: str = "") -> None:
        super().__init__(key, default, label, tip, widget)

    def _parse(self, text: str) -> bool:
        if text not in _SWITCHES:
            raise _UnusableError(f"“{text}” is neither “on” nor “off”")
        return text == "on"

    def _stored(self, value: bool) -> object:
        return _SWITCHES[value]


class WholeNumber(TextSetting[int]):
    """Whole number within limits, both included."""

    def __init__(
        self,
        key: str,
        default: int,
        limits: tuple[int, int],
        label: str = "",
        tip: str = "",
        widget: str = "",
    ) -> None:
        super().__init__(key, default, label, tip, widget)
        self.limits = limits

    def _parse(self, text: str) -> int:
        least, most = self.limits
        if re.fullmatch(r"-?[0-9]{1,9}", text) and least <= int(text) <= most:
            return int(text)
        raise _UnusableError(f"“{text}” is not a whole number from {least} to {most}")

    def _stored(self, value: int) -> object:
        return str(value)


class Distance(TextSetting[float]):
    """Distance in units of the plane; 0 for none.

    Attributes
    ----------
    none, refusal
        The word for that; the sentence where something else than a distance is typed.
    """

    def __init__(self, key: str, label: str, tip: str, *, none: str, refusal: str, widget: str = "") -> None:
        super().__init__(key, 0.0, label, tip, widget)
        self.none, self.refusal = none, refusal

    def _parse(self, text: str) -> float:
        try:
            distance = float(text)
        except ValueError:
            distance = math.nan
        if distance == 0 or _LEAST_SPACING <= distance <= _GREATEST_SPACING:
            return distance
        raise _UnusableError(f"“{text}” is not a distance")

    def _stored(self, value: float) -> object:
        return repr(float(value))


class SavedText(TextSetting[str]):
    """Text that the program writes."""

    def __init__(self, key: str) -> None:
        super().__init__(key, "")

    def _parse(self, text: str) -> str:
        return text


class SavedStyle(TextSetting[Style]):
    """Style, as JSON; a plain line when not set."""

    def __init__(self, key: str) -> None:
        super().__init__(key, PLAIN_STYLE)

    def _parse(self, text: str) -> Style:
        try:
            held = msgspec.json.decode(text, type=dict[str, Any])
            # Older versions had more fields.
            known = {name: value for name, value in held.items() if name in Style.__struct_fields__}
            style = msgspec.convert(known, Style)
            check_fields(style, "style")
        except (msgspec.MsgspecError, FormatError):
            raise _UnusableError("it is not a style") from None
        return style

    def _stored(self, value: Style) -> object:
        return msgspec.json.encode(value).decode()


class SavedCurve(TextSetting[Curve]):
    """Curve without points, as a document; the default curve when not set."""

    def __init__(self, key: str) -> None:
        super().__init__(key, empty_document().curves[0])

    def _parse(self, text: str) -> Curve:
        try:
            curve = decode(text.encode()).curves[0]
        except FormatError:
            raise _UnusableError("it is not a curve") from None
        # Its family may be defined in a file of families that is not in use now.
        return self.default if curve.family.is_missing else curve

    def _stored(self, value: Curve) -> object:
        return encode(Document((value,))).decode()


class Text(TextSetting[str]):
    """Short text; longer text in the file is cut.

    Attributes
    ----------
    longest
        Largest number of letters.
    usual
        Suggested texts; the first stands for none.
    note
        Function that returns a note about a text, shown beside it; empty for none.
    """

    def __init__(
        self,
        key: str,
        label: str,
        tip: str,
        *,
        longest: int,
        usual: Sequence[str],
        note: Callable[[str], str] = lambda _: "",
        widget: str = "",
    ) -> None:
        super().__init__(key, "", label, tip, widget)
        self.longest, self.usual, self.note = longest, usual, note

    def _parse(self, text: str) -> str:
        if not text.isprintable():
            raise _UnusableError("it contains characters that cannot be displayed")
        return text[: self.longest]


class Keys(Setting[dict[str, str]]):
    """Keys of actions, by the names of the actions."""

    def _read(self, file: SettingsFile) -> dict[str, str]:
        try:
            keys_by_action = json.loads(file.text(self.key) or "{}")
        except ValueError:
            keys_by_action = None
        if isinstance(keys_by_action, dict) and all(
            isinstance(keys, str) for keys in keys_by_action.values()
        ):
            return keys_by_action
        file.complain(self.key, "it is not a list of keys")
        return {}

    def __set__(self, owner: Remembering, value: Mapping[str, str]) -> None:
        super().__set__(owner, dict(value))

    def _stored(self, value: dict[str, str]) -> object:
        return json.dumps(value, sort_keys=True)


class Several(Setting[frozenset[Member]]):
    """Set of members of an enumeration with words as values; all members when not set.

    Words beside known ones are skipped: older versions had more members.
    """

    def __init__(self, key: str, kind: type[Member], label: str, tip: str, widget: str = "") -> None:
        super().__init__(key, label, tip, widget)
        self.kind = kind

    def _read(self, file: SettingsFile) -> frozenset[Member]:
        stored = file.value(self.key)
        if stored is None:
            return frozenset(self.kind)
        words = str(stored).split()
        members = frozenset(member for member in self.kind if member.value in words)
        if members or not words:
            return members
        known = ", ".join(member.value for member in self.kind)
        file.complain(self.key, f"“{stored}” contains none of {known}")
        return frozenset(self.kind)

    def __set__(self, owner: Remembering, value: Collection[Member]) -> None:
        super().__set__(owner, frozenset(value))

    def _stored(self, value: frozenset[Member]) -> object:
        return " ".join(member.value for member in self.kind if member in value)


class SavedLayout(Setting[QByteArray]):
    """Layout saved by Qt; empty when not set."""

    def _read(self, file: SettingsFile) -> QByteArray:
        return file.layout(self.key)


class Folder(Setting[Path]):
    """Folder; the home folder when not set, or when it no longer exists."""

    def _read(self, file: SettingsFile) -> Path:
        # Also False for a missing drive or a name with a NUL.
        stored = file.text(self.key)
        return Path(stored) if os.path.isdir(stored) else Path.home()  # noqa: PTH112

    def _stored(self, value: Path) -> object:
        return str(value.absolute())


def settings_with_labels(owner: type) -> dict[str, Setting[Any]]:
    """Return the settings of a class that the dialog of preferences shows, by name, in order."""
    members = {name: member for kind in reversed(owner.__mro__) for name, member in vars(kind).items()}
    return {name: kind for name, kind in members.items() if isinstance(kind, Setting) and kind.label}
