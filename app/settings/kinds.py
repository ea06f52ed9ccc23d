"""The kinds of settings: how the text in the file of settings becomes a value, and is made from one.

A setting is an attribute of a class that has a `SettingsFile`::

    class Preferences:
        snap_on = Switch("snap/on", default=False)

Reading it never raises because of what is in the file: a value that cannot be used is complained about, and
the default counts.
"""

from __future__ import annotations

import json
import os
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from enum import Enum
from pathlib import Path
from typing import Final, Generic, Protocol, TypeVar, overload

from PySide6.QtCore import QByteArray

from app.document.words import enumerated
from app.settings.file import SettingsFile

Value = TypeVar("Value")
Member = TypeVar("Member", bound=Enum)
Number = TypeVar("Number", bound=float)

_SWITCHES: Final = ("off", "on")


class Remembering(Protocol):
    """Object that has settings."""

    @property
    def file(self) -> SettingsFile:
        """The file that keeps them."""


class _UnusableError(ValueError):
    """A text that is no value of a setting; its message says why."""


class Setting(ABC, Generic[Value]):
    """One setting, kept under `key`."""

    def __init__(self, key: str) -> None:
        self.key = key

    @overload
    def __get__(self, owner: None, kind: type) -> Setting[Value]: ...
    @overload
    def __get__(self, owner: Remembering, kind: type) -> Value: ...
    def __get__(self, owner: Remembering | None, kind: type) -> Setting[Value] | Value:
        return self if owner is None else self._read(owner.file)

    def __set__(self, owner: Remembering, value: Value) -> None:
        owner.file.write(self.key, self._stored(value))

    @abstractmethod
    def _read(self, file: SettingsFile) -> Value:
        """Return what the file holds, or the default."""

    def _stored(self, value: Value) -> object:
        """Return what the file shall hold."""
        return value


class TextSetting(Setting[Value]):
    """A setting that is a text in the file; an empty one counts as none."""

    def __init__(self, key: str, default: Value) -> None:
        super().__init__(key)
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
    """One member of an enumeration whose values are words."""

    def _parse(self, text: str) -> Member:
        kind = type(self.default)
        try:
            return kind(text)
        except ValueError:
            known = enumerated([member.value for member in kind])
            raise _UnusableError(f"“{text}” is none of {known}") from None

    def _stored(self, value: Member) -> object:
        return value.value


class Switch(TextSetting[bool]):
    """On or off."""

    def __init__(self, key: str, *, default: bool) -> None:
        super().__init__(key, default)

    def _parse(self, text: str) -> bool:
        if text not in _SWITCHES:
            raise _UnusableError(f"“{text}” is neither on nor off")
        return text == "on"

    def _stored(self, value: bool) -> object:
        return _SWITCHES[value]


class Amount(TextSetting[Number]):
    """A number of one kind within limits; 0 for none. `word` is what it is called where it is none."""

    def __init__(
        self, key: str, kind: Callable[[str], Number], limits: tuple[float, float], word: str
    ) -> None:
        super().__init__(key, kind("0"))
        self.kind, self.limits, self.word = kind, limits, word

    def _parse(self, text: str) -> Number:
        with suppress(ValueError):
            amount = self.kind(text)
            if amount == 0 or self.limits[0] <= amount <= self.limits[1]:
                return amount
        raise _UnusableError(f"“{text}” is no {self.word}")

    def _stored(self, value: Number) -> object:
        return repr(self.kind(str(value)))


class Text(TextSetting[str]):
    """Any text; of one that was made longer in the file, the beginning."""

    def __init__(self, key: str, *, longest: int | None = None) -> None:
        super().__init__(key, "")
        self.longest = longest

    def _parse(self, text: str) -> str:
        return text[: self.longest]


class Keys(Setting[dict[str, str]]):
    """Keys of the keyboard by the names of actions."""

    def _read(self, file: SettingsFile) -> dict[str, str]:
        try:
            found = json.loads(file.text(self.key) or "{}")
        except ValueError:
            found = None
        if isinstance(found, dict) and all(isinstance(keys, str) for keys in found.values()):
            return found
        file.complain(self.key, "they are not a list of keys")
        return {}

    def __set__(self, owner: Remembering, value: Mapping[str, str]) -> None:
        super().__set__(owner, dict(value))

    def _stored(self, value: dict[str, str]) -> object:
        return json.dumps(value, sort_keys=True)


class Several(Setting[frozenset[Member]]):
    """Some members of an enumeration whose values are words; all of them when nothing is remembered."""

    def __init__(self, key: str, kind: type[Member]) -> None:
        super().__init__(key)
        self.kind = kind

    def _read(self, file: SettingsFile) -> frozenset[Member]:
        stored = file.value(self.key)
        if stored is None:
            return frozenset(self.kind)
        try:
            return frozenset(self.kind(word) for word in str(stored).split())
        except ValueError:
            words = ", ".join(member.value for member in self.kind)
            file.complain(self.key, f"“{stored}” names something else than {words}")
            return frozenset(self.kind)

    def __set__(self, owner: Remembering, value: Collection[Member]) -> None:
        super().__set__(owner, frozenset(value))

    def _stored(self, value: frozenset[Member]) -> object:
        return " ".join(member.value for member in self.kind if member in value)


class SavedLayout(Setting[QByteArray]):
    """A layout that Qt saved of a window; empty when nothing is remembered."""

    def _read(self, file: SettingsFile) -> QByteArray:
        return file.layout(self.key)


class Folder(Setting[Path]):
    """A folder; the home folder when nothing is remembered, or it is no longer there."""

    def _read(self, file: SettingsFile) -> Path:
        # A drive that is gone, or a name with a NUL in it, is no folder either.
        stored = file.text(self.key)
        return Path(stored) if os.path.isdir(stored) else Path.home()  # noqa: PTH112

    def _stored(self, value: Path) -> object:
        return str(value.absolute())
