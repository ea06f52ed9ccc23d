"""Letters of menus and their entries: underlined, typed with Alt, in each menu as different as can be."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QMenu

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
