"""Make the screenshots of the README, without a display: ``python tests/data/make_screenshots.py``."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from contextlib import nullcontext
from time import monotonic

from PySide6.QtWidgets import QApplication

from app.appearance.theme import ThemeMode
from app.families import FAMILIES, HERMITE
from app.families.family_file import families_of_files
from app.features.own_families.template import template
from app.settings.preferences import Preferences
from app.testing import Editor

FOLDER = Path(__file__).parents[2] / "resources" / "screenshots"


class Bot:
    """What the driver needs of pytest-qt, without a test."""

    def addWidget(self, widget, *, before_close_func=None):
        """Nothing closes the window before the program ends."""

    def waitExposed(self, widget):
        """Offscreen a window is there at once."""
        return nullcontext()


def main() -> None:
    """Draw every picture of the README."""
    app = QApplication(sys.argv)
    for picture in (first_sketch, analysis, laboratory, own_family):
        with tempfile.TemporaryDirectory() as folder:
            preferences = Preferences(Path(folder) / "settings.ini")
            editor = Editor(Bot(), preferences=preferences, size=(1280, 860))
            picture(app, editor)
            editor.session.files.give_up_changes()
            editor.window.close()


def take(app: QApplication, editor: Editor, name: str, mode: ThemeMode) -> None:
    """Take a picture once everything has settled."""
    editor.window.store.change(theme_mode=mode)
    end = monotonic() + 1.5
    while monotonic() < end:
        app.processEvents()
    editor.screenshot(FOLDER / f"{name}-{mode.value}.png")


def first_sketch(app: QApplication, editor: Editor) -> None:
    """The first sketch as a Hermite curve, with a point selected and the scrub line out."""
    editor.choose_family(HERMITE)
    editor.select_point(4)
    editor.scrub(0.52)
    take(app, editor, "editor", ThemeMode.LIGHT)


def analysis(app: QApplication, editor: Editor) -> None:
    """Comb, ghosts and plots."""
    editor.choose_family(HERMITE)
    for name in ("overlayComb", "ghostLagrange", "ghostUniform", "plotAcceleration", "plotCurvature"):
        editor.trigger(name)
    editor.fit()
    take(app, editor, "analysis", ThemeMode.LIGHT)


def own_family(app: QApplication, editor: Editor) -> None:
    """The template of a family with a factor left out, as its file is used."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "my_lagrange.py"
        path.write_text(template(path).replace("np.delete(parameters, i)", "np.delete(parameters, i)[:-1]"))
        with families_of_files(FAMILIES, [str(path)]):
            editor.window.actions_by_name.declare_again()
            editor.choose_family("my_lagrange")
            editor.fit()
            take(app, editor, "own-family", ThemeMode.DARK)
            editor.choose_family(HERMITE)
        editor.window.actions_by_name.declare_again()


def laboratory(app: QApplication, editor: Editor) -> None:
    """The first sketch computed with as few digits as the laboratory begins with."""
    editor.trigger("toggleLaboratory")
    editor.fit()
    editor.wait_for_rest()
    take(app, editor, "laboratory", ThemeMode.DARK)


if __name__ == "__main__":
    main()
