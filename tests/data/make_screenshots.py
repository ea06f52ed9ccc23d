"""Make the screenshots of the README, without a display: ``python tests/data/make_screenshots.py``."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from contextlib import nullcontext

from PySide6.QtWidgets import QApplication

from app.document.model import Family
from app.preferences import Preferences
from app.testing import Editor
from app.theme import ThemeMode

FOLDER = Path(__file__).parents[2] / "resources" / "screenshots"


class Bot:
    """What the driver needs of pytest-qt, without a test."""

    def addWidget(self, widget, *, before_close_func=None):
        """Nothing closes the window before the program ends."""

    def waitExposed(self, widget):
        """Offscreen a window is there at once."""
        return nullcontext()


def main() -> None:
    """Draw the first sketch as a Hermite curve, with a point selected and the scrub line out."""
    app = QApplication(sys.argv)
    with tempfile.TemporaryDirectory() as folder:
        editor = Editor(Bot(), preferences=Preferences(Path(folder) / "settings.ini"), size=(1280, 860))
        editor.choose_family(Family.HERMITE)
        editor.select_point(4)
        editor.scrub(0.52)
        for mode in (ThemeMode.LIGHT, ThemeMode.DARK):
            editor.window.set_theme_mode(mode)
            for _ in range(200):
                app.processEvents()
            editor.screenshot(FOLDER / f"editor-{mode.value}.png")


if __name__ == "__main__":
    main()
