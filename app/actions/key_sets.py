"""Sets of keys that people know from elsewhere: taken over at once, in the editor of keys."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, NamedTuple


class KeySet(NamedTuple):
    """Keys of a program.

    Attributes
    ----------
    name, title
        Its name inside the program, and what people call it.
    keys
        The keys of actions by the names of these, each after a semicolon; empty for none.
    """

    name: str
    title: str
    keys: Mapping[str, str]


INKSCAPE: Final = KeySet(
    "inkscape",
    "Inkscape",
    {
        "selectTool": "S; V",
        "addTool": "B; Shift+F6",
        "pencilTool": "P",
        "rectangleTool": "R",
        "ellipseTool": "F5",
        "starTool": "*",
        "gradientTool": "G; Ctrl+F1",
        "moveSelection": "",
        "scaleSelection": "",
        "rotateSelection": "",
        "editCurve": "N; F2",
        "flipVertically": "Shift+V",
        "pageAroundCurves": "Ctrl+Shift+R",
        "toggleRulers": "Ctrl+R",
        "reverseCurve": "Shift+R",
        "skewSelection": "",
        "strokeToPath": "Ctrl+Alt+C",
        "ungroupCurves": "Ctrl+Shift+G; Ctrl+U",
    },
)

KEY_SETS: Final = (INKSCAPE,)
"""All of them."""
