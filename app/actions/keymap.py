"""Keys of actions: defaults, changes by the user, the owner of a key; and mnemonics of menus."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from enum import Enum

import msgspec
from PySide6.QtCore import QKeyCombination, QObject, Qt, Signal
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu

RESERVED = {
    Qt.Key.Key_Escape: "cancels the current operation, or steps back",
    Qt.Key.Key_Tab: "moves to the next point or field",
    Qt.Key.Key_Backtab: "moves to the previous point or field",
    Qt.Key.Key_Space: "pans with the mouse while held",
    Qt.Key.Key_E: "also moves the following ticks of the t-rail while held",
    Qt.Key.Key_Left: "moves the selection",
    Qt.Key.Key_Right: "moves the selection",
    Qt.Key.Key_Up: "moves the selection",
    Qt.Key.Key_Down: "moves the selection",
    Qt.Key.Key_Return: "confirms typed input",
    Qt.Key.Key_Enter: "confirms typed input",
}
"""Keys that the canvas and fields use, alone or with Shift; no action can have them."""

_FULL_NAME, _NEEDS, _REASON, _KEYWORDS = "fullName", "needs", "reason", "keywords"
_IS_REDUNDANT = "isRedundant"


class Binding(msgspec.Struct, frozen=True):
    """Action with its default keys.

    Attributes
    ----------
    action
        The QAction; it has the current keys.
    text, menu
        The name of the action, and the title of its menu.
    defaults
        The default keys.
    """

    action: QAction
    text: str
    menu: str
    defaults: tuple[QKeySequence, ...]


class Keymap(QObject):
    """Keys of all actions of a window.

    Signals
    -------
    changed
        The keys of an action have changed.
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._bindings: dict[str, Binding] = {}
        # By default key: Qt reports a key that two actions have only when it is pressed.
        self._defaults: dict[str, Binding] = {}

    def add(self, binding: Binding) -> None:
        """Add an action and give it its default keys.

        Raises
        ------
        ValueError
            If one of the keys is reserved, or is the default key of another action.
        """
        for key in binding.defaults:
            if reason := refusal(key):
                raise ValueError(f"“{binding.text}” cannot have its default key: {reason}")
            other = self._defaults.setdefault(key.toString(), binding)
            if other is not binding:
                raise ValueError(
                    f"“{other.text}” and “{binding.text}” both have the default key {native(key)}."
                )
        self._bindings[binding.action.objectName()] = binding
        _bind(binding.action, binding.defaults)

    def remove(self, name: str) -> None:
        """Remove an action and free its keys."""
        binding = self._bindings.pop(name)
        self._defaults = {key: other for key, other in self._defaults.items() if other is not binding}
        _bind(binding.action, [])

    @property
    def bindings(self) -> Mapping[str, Binding]:
        """Every action that may have keys, by name."""
        return self._bindings

    def keys(self, name: str) -> list[QKeySequence]:
        """Return the current keys of an action; the first is the one that is displayed."""
        return self._bindings[name].action.shortcuts()

    def default_keys(self, name: str) -> tuple[QKeySequence, ...]:
        """Return the default keys of an action."""
        return self._bindings[name].defaults

    def is_default(self, name: str) -> bool:
        """Return whether an action has its default keys."""
        return self.keys(name) == list(self.default_keys(name))

    def owner_of(self, key: QKeySequence) -> str | None:
        """Return the name of the action whose keys clash with `key`; None where it is free."""
        return next(self._owners_of(key), None)

    def _owners_of(self, key: QKeySequence) -> Iterator[str]:
        for name, binding in self._bindings.items():
            if any(_clash(bound, key) for bound in binding.action.shortcuts()):
                yield name

    def disabled_at(self, keys: QKeyCombination) -> QAction | None:
        """Return the disabled action with these keys; None where there is none.

        Qt passes the keys of a disabled action on, as if no action had them.
        """
        held = keys.keyboardModifiers() & ~Qt.KeyboardModifier.KeypadModifier
        key = QKeySequence(QKeyCombination(held, keys.key()))
        for binding in self._bindings.values():
            if not binding.action.isEnabled() and key in binding.action.shortcuts():
                return binding.action
        return None

    def assign(self, name: str, keys: Sequence[QKeySequence]) -> None:
        """Assign keys to an action, and remove them from all others."""
        self._give(name, keys)
        self.changed.emit()

    def _give(self, name: str, keys: Sequence[QKeySequence]) -> None:
        for key in keys:
            for owner in self._owners_of(key):
                remaining = [bound for bound in self.keys(owner) if not _clash(bound, key)]
                _bind(self._bindings[owner].action, remaining)
        _bind(self._bindings[name].action, keys)

    def reset(self, name: str) -> None:
        """Restore the default keys of an action, and remove them from all others."""
        self.assign(name, self.default_keys(name))

    def reset_all(self) -> None:
        """Restore the default keys of all actions."""
        for name, binding in self._bindings.items():
            _bind(binding.action, self.default_keys(name))
        self.changed.emit()

    @property
    def overrides(self) -> dict[str, str]:
        """Keys that differ from the defaults, by action, as portable text."""
        return {
            name: QKeySequence.listToString(self.keys(name), QKeySequence.SequenceFormat.PortableText)
            for name in self._bindings
            if not self.is_default(name)
        }

    def load(self, overrides: Mapping[str, str]) -> None:
        """Apply saved keys; unknown actions are skipped, and a key is assigned only once.

        Saved keys win over default keys, whose actions may be newer than the saved keys.
        """
        saved = {name: text for name, text in overrides.items() if name in self._bindings}
        for name in saved:
            _bind(self._bindings[name].action, [])
        for name, text in saved.items():
            keys = QKeySequence.listFromString(text, QKeySequence.SequenceFormat.PortableText)
            unused = [
                key for key in keys if not key.isEmpty() and saved.keys().isdisjoint(self._owners_of(key))
            ]
            self._give(name, unused)
        self.changed.emit()


def action_name(prefix: str, member: Enum) -> str:
    """Return the name of the action for a member of an enumeration: "ghostQuinticHermite"."""
    return prefix + "".join(word.capitalize() for word in str(member.value).replace("-", "_").split("_"))


def set_full_name(action: QAction, name: str) -> None:
    """Give an action a full name, for places where its menu is not visible."""
    action.setProperty(_FULL_NAME, name)


def set_keywords(action: QAction, keywords: str) -> None:
    """Give an action further words by which the command palette finds it."""
    action.setProperty(_KEYWORDS, keywords)


def keywords_of(action: QAction) -> str:
    """Return the further words by which the command palette finds an action."""
    return str(action.property(_KEYWORDS) or "")


def set_needs(action: QAction, needs: str) -> None:
    """Set the noun phrase of the need of an action."""
    action.setProperty(_NEEDS, needs)


def set_reason(action: QAction, reason: str, *, is_redundant: bool = False) -> None:
    """Set the sentence why an action cannot be used; empty for the usual one.

    `is_redundant` tells that the effect of the action is there already, so that this is no refusal.
    """
    action.setProperty(_REASON, reason)
    action.setProperty(_IS_REDUNDANT, is_redundant)


def is_redundant(action: QAction) -> bool:
    """Return whether the effect of a disabled action is there already."""
    return bool(action.property(_IS_REDUNDANT))


def reason_disabled(action: QAction) -> str:
    """Return the sentence why an action cannot be used."""
    if reason := action.property(_REASON):
        return str(reason)
    needs, name = action.property(_NEEDS), full_name_of(action).removesuffix("…")
    return f"“{name}” needs {needs}." if needs else f"“{name}” is not available here."


def full_name_of(action: QAction) -> str:
    """Return the name of an action where its menu is not visible."""
    return str(action.property(_FULL_NAME) or action.text().replace("&", ""))


def refusal(key: QKeySequence) -> str:
    """Return the sentence why no action can have `key`; empty where one can."""
    if key.isEmpty():
        return ""
    combination: QKeyCombination = key[0]  # type: ignore[index]  # PySide6's stubs lack __getitem__
    held = combination.keyboardModifiers()
    plain = held in (Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier)
    if plain and combination.key() in RESERVED:
        return f"{native(key)} {RESERVED[combination.key()]}; choose another key."
    return ""


def native(key: QKeySequence) -> str:
    """Return the text of a key in the notation of the system."""
    return key.toString(QKeySequence.SequenceFormat.NativeText)


def key_or_name(action: QAction) -> str:
    """Return the first key of an action, or its name where it has none, for a message."""
    keys = action.shortcuts()
    return native(keys[0]) if keys else f"“{full_name_of(action)}”"


def keys_text(keys: Iterable[QKeySequence]) -> str:
    """Return the text of some keys, such as "Ctrl+J or Alt+J"; empty for none."""
    return " or ".join(native(key) for key in keys)


def _clash(one: QKeySequence, other: QKeySequence) -> bool:
    """Return whether one of two key sequences begins with the other."""
    nothing = QKeySequence.SequenceMatch.NoMatch
    return one.matches(other) != nothing or other.matches(one) != nothing


def _bind(action: QAction, keys: Sequence[QKeySequence]) -> None:
    action.setShortcuts(list(keys))
    action.setToolTip(tool_tip(action))


def tool_tip(action: QAction) -> str:
    """Return the tip of an action with its first key, and for a disabled action the reason."""
    keys, needs = action.shortcuts(), action.property(_NEEDS)
    suffix = f" ({native(keys[0])})" if keys else ""
    reason = action.property(_REASON) or (f"Needs {needs}" if needs else "")
    missing = f"\n{reason}" if reason and not action.isEnabled() else ""
    return f"{action.statusTip()}{suffix}{missing}"


_LITERAL = "\0"


def plain(text: str) -> str:
    """Return the text of a menu without the "&" of its mnemonic; a literal "&&" stays."""
    return text.replace("&&", _LITERAL).replace("&", "").replace(_LITERAL, "&&")


def with_mnemonics(texts: Sequence[str]) -> list[str]:
    """Return texts with one letter of each marked by "&", with as few repetitions as possible.

    Earlier texts choose first, letters at the beginning of words before others. A text whose letters are all
    used makes another one change, where that has a free letter (augmenting paths, Kuhn 1955). Where there are
    more texts than letters, some share a letter; typing it cycles through them.
    """
    wishes = [_letters(plain(text)) for text in texts]
    owner: dict[str, int] = {}

    def settle(index: int, tried: set[str]) -> bool:
        free = [letter for letter in wishes[index] if letter not in owner]
        for letter in [*free, *wishes[index]]:
            if letter in tried:
                continue
            tried.add(letter)
            if letter not in owner or settle(owner[letter], tried):
                owner[letter] = index
                return True
        return False

    for index in range(len(texts)):
        settle(index, set())
    indices = {index: next(iter(letters.values()), None) for index, letters in enumerate(wishes)}
    indices.update({index: wishes[index][letter] for letter, index in owner.items()})
    return [_marked(plain(text), indices[index]) for index, text in enumerate(texts)]


def _letters(text: str) -> dict[str, int]:
    """Return the index of each letter or digit of a text, those at the beginning of words first."""
    letters_at = [
        (index, letter) for index, letter in enumerate(text) if letter.isascii() and letter.isalnum()
    ]
    begin = [(index, letter) for index, letter in letters_at if index == 0 or not text[index - 1].isalnum()]
    first: dict[str, int] = {}
    for index, letter in [*begin, *letters_at]:
        first.setdefault(letter.casefold(), index)
    return first


def _marked(text: str, index: int | None) -> str:
    return text if index is None else f"{text[:index]}&{text[index:]}"


def give_mnemonics(menu: QMenu) -> None:
    """Mark the entries of a menu while it is open, because their texts may change until then."""
    menu.aboutToShow.connect(lambda: _mark(menu))
    menu.aboutToHide.connect(lambda: _unmark(menu))


def _mark(menu: QMenu) -> None:
    actions = [action for action in menu.actions() if action.text()]
    for action, text in zip(actions, with_mnemonics([action.text() for action in actions]), strict=True):
        action.setText(text)


def _unmark(menu: QMenu) -> None:
    # Elsewhere an entry has its plain text.
    for action in menu.actions():
        action.setText(plain(action.text()))
