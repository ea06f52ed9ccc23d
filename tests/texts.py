"""Random text of all characters.

Hypothesis's own takes a table of all that Unicode says of them; in a new checkout it computes that first, for
a second.
"""

from __future__ import annotations

from hypothesis import strategies as st

_CODES = st.integers(0x20, 0x7E) | st.integers(0, 0xD7FF) | st.integers(0xE000, 0x10FFFF)
"""A third of them ASCII; none of the halves of a pair in UTF-16."""


def texts(max_size: int, alphabet: str = "") -> st.SearchStrategy[str]:
    """Return text of at most so many characters: of an alphabet, else of all there are."""
    characters = st.sampled_from(alphabet) if alphabet else _CODES.map(chr)
    return st.lists(characters, max_size=max_size).map("".join)
