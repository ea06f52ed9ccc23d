"""Fuzzy match of something typed with a name: whole words, beginnings, or letters in their order."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

_BEGINS, _BEGINS_WORD, _WITHIN, _SCATTERED = 100.0, 85.0, 60.0, 40.0
_IN_PATH, _IN_TIP, _BY_ANOTHER_NAME = 0.6, 0.3, 0.8
_LEAST_SCATTERED = 8.0

_ALSO_CALLED: Final = {
    "fill": ("colour",), "stroke": ("colour",), "color": ("colour",), "paint": ("colour",),
    "mirror": ("flip",), "reflect": ("flip",), "invert": ("reverse",),
    "remove": ("delete",), "erase": ("delete",), "resize": ("scale",),
    "turn": ("rotate",), "settings": ("preferences",), "options": ("preferences",), "hotkeys": ("shortcuts",),
    "night": ("dark",), "fullscreen": ("presentation",), "animate": ("play",),
}  # fmt: skip
"""Synonyms: words that people type, and those of this program for them."""


class SearchEntry(NamedTuple):
    """A command that can be found: name, the menus that lead to it, words about it, other words for it."""

    name: str
    path: str = ""
    tip: str = ""
    keywords: str = ""


def ranked(typed: str, things: Sequence[SearchEntry]) -> list[int]:
    """Return the places of the things that fit, the best first.

    Letters scattered over a name count only where no name contains them in one piece.
    """
    rated = [(fit, i) for i, thing in enumerate(things) if (fit := fitness(typed, *thing)) is not None]
    if any(_is_whole(typed, things[index]._replace(tip="")) for _, index in rated):
        rated = [(fit, index) for fit, index in rated if _is_whole(typed, things[index])]
    return [index for _, index in sorted(rated, key=lambda pair: -pair[0])]


def fitness(typed: str, name: str, path: str = "", tip: str = "", keywords: str = "") -> float | None:
    """Return the score of `typed` for an entry; None for no match.

    Every word typed must be found: in the name, or where a word of the path, the tip or the keywords begins.
    """
    total = 0.0
    for word in typed.casefold().split():
        best = _fitness_of(word, name, path, tip, keywords)
        if best < _SCATTERED:
            best = max(best, _scattered_in(word, name.casefold()))
        if best <= 0:
            return None
        total += best
    if typed.strip() and name.casefold().startswith(" ".join(typed.casefold().split())):
        total += _BEGINS  # the words as they were typed are how it is called
    # Of two equal matches the shorter name wins.
    return total - 0.05 * len(name)


def _is_whole(typed: str, thing: SearchEntry) -> bool:
    """Whether every word that was typed is found in one piece."""
    return all(_fitness_of(word, *thing) > 0 for word in typed.casefold().split())


def _fitness_of(word: str, name: str, path: str, tip: str, keywords: str) -> float:
    """Return the score of a word as a substring; 0 for no match."""
    others = [_word_fitness(other, name.casefold()) for other in _ALSO_CALLED.get(word, ())]
    return max(
        _word_fitness(word, name.casefold()),
        _BY_ANOTHER_NAME * max(others, default=0.0),
        _BY_ANOTHER_NAME * _BEGINS_WORD if _begins_word(word, keywords.casefold()) else 0.0,
        _BEGINS_WORD * _IN_PATH if _begins_word(word, path.casefold()) else 0.0,
        _BEGINS_WORD * _IN_TIP if _begins_word(word, tip.casefold()) else 0.0,
    )


def _word_fitness(word: str, text: str) -> float:
    if text.startswith(word):
        return _BEGINS
    if _begins_word(word, text):
        return _BEGINS_WORD
    return _WITHIN if word in text else 0.0


def _begins_word(word: str, text: str) -> bool:
    # Most texts do not contain the word and are not split: there are a thousand at every letter.
    return word in text and any(part.startswith(word) for part in text.split())


def _scattered_in(word: str, text: str) -> float:
    return max((_scattered(word, text, i) for i, letter in enumerate(text) if letter == word[0]), default=0.0)


def _scattered(word: str, text: str, start: int) -> float:
    """Rate the letters of `word` found in order from `start` on; gaps cost, beginnings of words are free."""
    score, index = _SCATTERED, start
    for letter in word[1:]:
        following = text.find(letter, index + 1)
        if following < 0:
            return 0.0
        initial = text.find(f" {letter}", index) + 1
        if initial > 0 and following != index + 1:
            following = initial
        elif following != index + 1:
            score -= 3.0 + (following - index)
        index = following
    return score if score >= _LEAST_SCATTERED else 0.0
