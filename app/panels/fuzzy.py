"""How well something typed fits a name: whole words, beginnings, or letters in their order."""

from __future__ import annotations

_BEGINS, _BEGINS_WORD, _WITHIN, _SCATTERED = 100.0, 85.0, 60.0, 40.0
_IN_PATH, _IN_TIP = 0.6, 0.3
_LEAST_SCATTERED = 8.0


def fitness(typed: str, name: str, path: str = "", tip: str = "") -> float | None:
    """Return how well `typed` fits; None where it does not.

    Every word typed must be found: in the name, the path to it, or (as it stands) in the tip.
    """
    total = 0.0
    for word in typed.casefold().split():
        found = [
            _word_fitness(word, name.casefold()),
            _word_fitness(word, path.casefold()) * _IN_PATH,
            _BEGINS_WORD * _IN_TIP if _begins_word(word, tip.casefold()) else 0.0,
        ]
        best = max(found)
        if best <= 0:
            return None
        total += best
    # Of two that fit alike the shorter is meant.
    return total - 0.05 * len(name)


def _word_fitness(word: str, text: str) -> float:
    if text.startswith(word):
        return _BEGINS
    if _begins_word(word, text):
        return _BEGINS_WORD
    if word in text:
        return _WITHIN
    return max((_scattered(word, text, i) for i, letter in enumerate(text) if letter == word[0]), default=0.0)


def _begins_word(word: str, text: str) -> bool:
    return any(part.startswith(word) for part in text.split())


def _scattered(word: str, text: str, start: int) -> float:
    """Rate the letters of `word` found in order from `start` on; gaps cost, beginnings of words are free."""
    score, place = _SCATTERED, start
    for letter in word[1:]:
        following = text.find(letter, place + 1)
        if following < 0:
            return 0.0
        initial = text.find(f" {letter}", place) + 1
        if initial > 0 and following != place + 1:
            following = initial
        elif following != place + 1:
            score -= 3.0 + (following - place)
        place = following
    return score if score >= _LEAST_SCATTERED else 0.0
