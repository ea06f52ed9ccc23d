"""Keys of actions: the defaults, what the person changed, and the owner of a key; mnemonics of menus."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from enum import Enum

import msgspec
from PySide6.QtCore import QKeyCombination, QObject, Qt, Signal
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu

RESERVED = {
    Qt.Key.Key_Escape: "cancels what is going on, or steps back",
    Qt.Key.Key_Tab: "goes to the next point or field",
    Qt.Key.Key_Backtab: "goes to the previous point or field",
    Qt.Key.Key_Space: "pans with the mouse while held",
    Qt.Key.Key_E: "moves the following ticks of the t-rail along while held",
    Qt.Key.Key_Left: "moves the selection",
    Qt.Key.Key_Right: "moves the selection",
    Qt.Key.Key_Up: "moves the selection",
    Qt.Key.Key_Down: "moves the selection",
    Qt.Key.Key_Return: "confirms typed input",
    Qt.Key.Key_Enter: "confirms typed input",
}
"""Keys that, alone or with Shift, belong to the drawing and to the fields; an action cannot have them."""

_FULL_NAME, _NEEDS, _REASON, _KEYWORDS = "fullName", "needs", "reason", "keywords"
_IS_SO = "isSoAlready"


class Binding(msgspec.Struct, frozen=True):
    """An action that may have keys.

    Attributes
    ----------
    action
        The action itself; it carries the keys in force.
    text, menu
        What it is called, and the menu it stands in.
    defaults
        The keys it has unless the person changes them.
    """

    action: QAction
    text: str
    menu: str
    defaults: tuple[QKeySequence, ...]


class Keymap(QObject):
    """The keys of all actions of a window.

    Signals
    -------
    changed
        An action has other keys.
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._bindings: dict[str, Binding] = {}
        # By the key that it comes with: Qt tells of a key that two actions have only when it is pressed.
        self._came_with: dict[str, Binding] = {}

    def add(self, binding: Binding) -> None:
        """Take in an action and give it its default keys.

        Raises
        ------
        ValueError
            If one of them belongs to the drawing, or is another action's.
        """
        for key in binding.defaults:
            if reason := refusal(key):
                raise ValueError(f"“{binding.text}” cannot have its default key: {reason}")
            other = self._came_with.setdefault(key.toString(), binding)
            if other is not binding:
                raise ValueError(
                    f"“{other.text}” and “{binding.text}” both have the default key {native(key)}."
                )
        self._bindings[binding.action.objectName()] = binding
        _bind(binding.action, binding.defaults)

    def remove(self, name: str) -> None:
        """Forget an action; its keys are free."""
        binding = self._bindings.pop(name)
        self._came_with = {key: each for key, each in self._came_with.items() if each is not binding}
        _bind(binding.action, [])

    @property
    def bindings(self) -> Mapping[str, Binding]:
        """Every action that may have keys, by name."""
        return self._bindings

    def keys(self, name: str) -> list[QKeySequence]:
        """Return the keys of an action, the first being the one that is shown."""
        return self._bindings[name].action.shortcuts()

    def came_with(self, name: str) -> tuple[QKeySequence, ...]:
        """Return the keys that an action comes with."""
        return self._bindings[name].defaults

    def is_default(self, name: str) -> bool:
        """Whether an action has the keys it came with."""
        return self.keys(name) == list(self.came_with(name))

    def owner_of(self, key: QKeySequence) -> str | None:
        """Return the name of the action that has `key`, or begins with it, or that it begins with."""
        return next(self._owners_of(key), None)

    def _owners_of(self, key: QKeySequence) -> Iterator[str]:
        for name, binding in self._bindings.items():
            if any(_clash(own, key) for own in binding.action.shortcuts()):
                yield name

    def disabled_at(self, keys: QKeyCombination) -> QAction | None:
        """Return the action with these keys that cannot be used now; None where there is none.

        Qt passes the keys of an action that is disabled on, as if they were nobody's.
        """
        held = keys.keyboardModifiers() & ~Qt.KeyboardModifier.KeypadModifier
        key = QKeySequence(QKeyCombination(held, keys.key()))
        for binding in self._bindings.values():
            if not binding.action.isEnabled() and key in binding.action.shortcuts():
                return binding.action
        return None

    def assign(self, name: str, keys: Sequence[QKeySequence]) -> None:
        """Give an action these keys, and take them from whoever has them."""
        self._give(name, keys)
        self.changed.emit()

    def _give(self, name: str, keys: Sequence[QKeySequence]) -> None:
        for key in keys:
            for owner in self._owners_of(key):
                kept = [own for own in self.keys(owner) if not _clash(own, key)]
                _bind(self._bindings[owner].action, kept)
        _bind(self._bindings[name].action, keys)

    def reset(self, name: str) -> None:
        """Give an action the keys it came with, and take them from whoever has them."""
        self.assign(name, self.came_with(name))

    def reset_all(self) -> None:
        """Give every action the keys it came with."""
        for name, binding in self._bindings.items():
            _bind(binding.action, self.came_with(name))
        self.changed.emit()

    @property
    def overrides(self) -> dict[str, str]:
        """The keys that differ from the defaults, as text that does not depend on the language."""
        return {
            name: QKeySequence.listToString(self.keys(name), QKeySequence.SequenceFormat.PortableText)
            for name in self._bindings
            if not self.is_default(name)
        }

    def load(self, overrides: Mapping[str, str]) -> None:
        """Take up remembered keys; what no longer exists is skipped, and a key is given out only once.

        They are taken from the actions that came with them: those may be newer than what is remembered.
        """
        own = {name: text for name, text in overrides.items() if name in self._bindings}
        for name in own:
            _bind(self._bindings[name].action, [])
        for name, text in own.items():
            keys = QKeySequence.listFromString(text, QKeySequence.SequenceFormat.PortableText)
            free = [key for key in keys if not key.isEmpty() and own.keys().isdisjoint(self._owners_of(key))]
            self._give(name, free)
        self.changed.emit()


def action_name(prefix: str, member: Enum) -> str:
    """Return the name of the action for a member of an enumeration: "ghostQuinticHermite"."""
    return prefix + "".join(word.capitalize() for word in str(member.value).replace("-", "_").split("_"))


def set_full_name(action: QAction, name: str) -> None:
    """Give an action a full name, for where the menu around it is not seen."""
    action.setProperty(_FULL_NAME, name)


def set_keywords(action: QAction, keywords: str) -> None:
    """Give an action words by which it is found, beside those of its name and tip."""
    action.setProperty(_KEYWORDS, keywords)


def keywords_of(action: QAction) -> str:
    """Return the words by which an action is found, beside those of its name and tip."""
    return str(action.property(_KEYWORDS) or "")


def say_needs(action: QAction, needs: str) -> None:
    """Tell an action what must be there before it can be used."""
    action.setProperty(_NEEDS, needs)


def say_reason(action: QAction, reason: str, *, is_so: bool = False) -> None:
    """Tell an action why it cannot be used, as a sentence; empty where it only needs something.

    What it would do `is_so` already, or something is missing.
    """
    action.setProperty(_REASON, reason)
    action.setProperty(_IS_SO, is_so)


def is_so_already(action: QAction) -> bool:
    """Whether an action that cannot be used would do what is so already."""
    return bool(action.property(_IS_SO))


def why_not(action: QAction) -> str:
    """Return what is missing where an action cannot be used, as a sentence."""
    if reason := action.property(_REASON):
        return str(reason)
    needs, name = action.property(_NEEDS), full_name_of(action).removesuffix("…")
    return f"“{name}” needs {needs}." if needs else f"“{name}” is not available here."


def full_name_of(action: QAction) -> str:
    """Return what an action is called where its menu is not seen."""
    return str(action.property(_FULL_NAME) or action.text().replace("&", ""))


def refusal(key: QKeySequence) -> str:
    """Return why no action can have `key`, as a sentence; empty where one can."""
    if key.isEmpty():
        return ""
    combination: QKeyCombination = key[0]  # type: ignore[index]  # PySide6's stubs lack __getitem__
    held = combination.keyboardModifiers()
    plain = held in (Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier)
    if plain and combination.key() in RESERVED:
        return f"{native(key)} {RESERVED[combination.key()]}; choose another key."
    return ""


def native(key: QKeySequence) -> str:
    """Return a key as the person's system writes it."""
    return key.toString(QKeySequence.SequenceFormat.NativeText)


def key_or_name(action: QAction) -> str:
    """Return the first key of an action for a message, or its name where it has none."""
    keys = action.shortcuts()
    return native(keys[0]) if keys else f"“{full_name_of(action)}”"


def keys_text(keys: Iterable[QKeySequence]) -> str:
    """Return keys as a list in words, empty for none."""
    return " or ".join(native(key) for key in keys)


def _clash(one: QKeySequence, other: QKeySequence) -> bool:
    """Whether one of two keys begins with the other."""
    nothing = QKeySequence.SequenceMatch.NoMatch
    return one.matches(other) != nothing or other.matches(one) != nothing


def _bind(action: QAction, keys: Sequence[QKeySequence]) -> None:
    action.setShortcuts(list(keys))
    action.setToolTip(tool_tip(action))


def tool_tip(action: QAction) -> str:
    """Return what an action does, and the first of its keys; where it cannot be used, what it needs."""
    keys, needs = action.shortcuts(), action.property(_NEEDS)
    suffix = f" ({native(keys[0])})" if keys else ""
    reason = action.property(_REASON) or (f"Needs {needs}" if needs else "")
    missing = f"\n{reason}" if reason and not action.isEnabled() else ""
    return f"{action.statusTip()}{suffix}{missing}"


_LITERAL = "\0"


def plain(text: str) -> str:
    """Return the text of a menu without the sign of its mnemonic; a literal "&&" stays."""
    return text.replace("&&", _LITERAL).replace("&", "").replace(_LITERAL, "&&")


def with_mnemonics(texts: Sequence[str]) -> list[str]:
    """Return texts with one letter of each marked by "&", as few as can be twice.

    Earlier texts choose first: the letters that begin words, then those within. One that finds all its own
    taken makes another give way, if that has one to go to (augmenting paths, Kuhn 1955). Where there are more
    texts than letters, some share their first one: typed, it goes from the one to the other.
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
    places = {index: next(iter(letters.values()), None) for index, letters in enumerate(wishes)}
    places.update({index: wishes[index][letter] for letter, index in owner.items()})
    return [_marked(plain(text), places[index]) for index, text in enumerate(texts)]


def _letters(text: str) -> dict[str, int]:
    """Return where each letter or digit of a text stands, those that begin a word first."""
    found = [(place, letter) for place, letter in enumerate(text) if letter.isascii() and letter.isalnum()]
    begin = [(place, letter) for place, letter in found if place == 0 or not text[place - 1].isalnum()]
    letters: dict[str, int] = {}
    for place, letter in [*begin, *found]:
        letters.setdefault(letter.casefold(), place)
    return letters


def _marked(text: str, place: int | None) -> str:
    return text if place is None else f"{text[:place]}&{text[place:]}"


def give_mnemonics(menu: QMenu) -> None:
    """Mark the entries of a menu while it is open: what they are called may change until then."""
    menu.aboutToShow.connect(lambda: _mark(menu))
    menu.aboutToHide.connect(lambda: _unmark(menu))


def _mark(menu: QMenu) -> None:
    actions = [action for action in menu.actions() if action.text()]
    for action, text in zip(actions, with_mnemonics([each.text() for each in actions]), strict=True):
        action.setText(text)


def _unmark(menu: QMenu) -> None:
    # Elsewhere an entry is called by its name alone.
    for action in menu.actions():
        action.setText(plain(action.text()))
