"""Palettes: colours with their names, to paint with. One record each."""

from __future__ import annotations

from typing import Final

import msgspec

from .palette import OKABE_ITO


class Swatch(msgspec.Struct, frozen=True):
    """A colour, "#rrggbb", and what it is called; without a name by its number."""

    colour: str
    name: str = ""

    @property
    def words(self) -> str:
        """Its name and its number."""
        return f"{self.name}, {self.colour}" if self.name else self.colour


class Palette(msgspec.Struct, frozen=True):
    """Some colours.

    Attributes
    ----------
    title
        What it is called.
    swatches
        The colours, in their order.
    """

    title: str
    swatches: tuple[Swatch, ...]


def _ramp() -> tuple[Swatch, ...]:
    """Return greys from black to white, each a tenth lighter than the one before."""
    levels = [round(255 * tenth / 10) for tenth in range(11)]
    return tuple(
        Swatch(f"#{level:02x}{level:02x}{level:02x}", f"{100 - 10 * tenth} % grey")
        for tenth, level in enumerate(levels)
    )


def _shades(text: str, *words: str) -> tuple[Swatch, ...]:
    """Return the shades of hues, one a line: its name, and a colour for each of the words."""
    hues = [line.split(":") for line in text.strip().splitlines()]
    return tuple(
        Swatch(f"#{code}", f"{word} {name.strip()}".strip().capitalize())
        for name, codes in hues
        for word, code in zip(words, codes.split(), strict=True)
    )


_EDGES = (Swatch("#000000", "Black"), Swatch("#ffffff", "White"))
_OKABE_ITO_NAMES = (
    "Blue",
    "Vermillion",
    "Bluish green",
    "Reddish purple",
    "Orange",
    "Sky blue",
    "Yellow",
)

PALETTES: Final = (
    # Three shades of each hue, and of grey: Open Color 1.9, © 2016 heeyeun, MIT licence.
    Palette(
        "Open Color",
        _EDGES
        + _shades(
            """
            gray: dee2e6 868e96 212529
            red: ffa8a8 fa5252 c92a2a
            pink: faa2c1 e64980 a61e4d
            grape: e599f7 be4bdb 862e9c
            violet: b197fc 7950f2 5f3dc4
            indigo: 91a7ff 4c6ef5 364fc7
            blue: 74c0fc 228be6 1864ab
            cyan: 66d9e8 15aabf 0b7285
            teal: 63e6be 12b886 087f5b
            green: 8ce99a 40c057 2b8a3e
            lime: c0eb75 82c91e 5c940d
            yellow: ffe066 fab005 e67700
            orange: ffc078 fd7e14 d9480f
            """,
            "light",
            "",
            "dark",
        ),
    ),
    # The Tango Desktop Project's, which is in the public domain.
    Palette(
        "Tango",
        _EDGES
        + _shades(
            """
            butter: fce94f edd400 c4a000
            orange: fcaf3e f57900 ce5c00
            chocolate: e9b96e c17d11 8f5902
            chameleon: 8ae234 73d216 4e9a06
            sky blue: 729fcf 3465a4 204a87
            plum: ad7fa8 75507b 5c3566
            scarlet red: ef2929 cc0000 a40000
            aluminium: eeeeec d3d7cf babdb6
            slate: 888a85 555753 2e3436
            """,
            "light",
            "",
            "dark",
        ),
    ),
    Palette(
        "Okabe–Ito",
        (_EDGES[0], *map(Swatch, OKABE_ITO["dark"], _OKABE_ITO_NAMES)),
    ),
    Palette("Greys", _ramp()),
)
"""Those that ship with the program."""
