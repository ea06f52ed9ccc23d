"""Palettes below the canvas: those that ship, those of files, and the document's own colours."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QFileDialog

from ... import storage
from ...actions.declaration import action, switch
from ...actions.sections import CURVE_STYLE, VIEW_MODE
from ...appearance.theme import LIGHT, Theme
from ...document.words import count_of
from ...state.window_state import WindowState
from ...storage.files import StorageError
from ...storage.reasons import shown
from ...view_model.look.palettes import PALETTES, Palette, Swatch
from ...workbench.context import WindowContext
from .. import style
from .used_colours import UsedColours

if TYPE_CHECKING:
    from .palette_bar import PaletteBar

_OWN = "Document’s Colours"


class PaletteCommands:
    """Shows the strip in drawings, and gives what is chosen the colours that are clicked there."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session, self._store = context, context.session, context.store
        self._preferences = context.preferences
        self._colours = UsedColours(context.session, context.preferences)
        self._bar: PaletteBar | None = None
        self._read: tuple[str, tuple[Palette, ...]] = ("", ())
        self._theme = LIGHT
        context.store.changed.connect(self._follow)

    @property
    def palettes(self) -> tuple[Palette, ...]:
        """All that there are; the document's own colours come last."""
        own = Palette(_OWN, tuple(map(Swatch, self._colours.in_document)))
        return (*PALETTES, *self._imported, own)

    @property
    def _imported(self) -> tuple[Palette, ...]:
        """Those of files that can be read."""
        kept = self._preferences.palette_files
        if self._read[0] != kept:
            found = []
            for path in _paths_in(kept):
                try:
                    found.append(_palette_in(path))
                except StorageError:
                    continue  # a drive that is gone; whoever imports it again is told
            self._read = kept, tuple(found)
        return self._read[1]

    def show_document(self) -> None:
        """Show what the document has, where the strip is shown."""
        self._render()

    def set_theme(self, theme: Theme) -> None:
        """Show the colours as they are on the paper of `theme`."""
        self._theme = theme
        self._render()

    def _follow(self, before: WindowState, after: WindowState) -> None:
        if (before.shows_palette, before.kind) != (after.shows_palette, after.kind):
            self._render()

    def _render(self) -> None:
        """Show the strip, or hide it; it is made when it is first shown."""
        is_shown = self._store.state.shows_palette
        if self._bar is None:
            if not is_shown:
                return
            bar = self._bar = style.palette_bar.PaletteBar(self._context.actions["importPalette"])
            bar.chosen.connect(self._context.central.canvas.colour_picked)
            bar.palette_chosen.connect(self._choose)
            bar.hide()
            self._context.central.under_canvas.addWidget(bar)
        if is_shown is self._bar.isHidden():
            self._show(self._bar, is_shown)
        if is_shown:
            palettes = self.palettes
            titles, wanted = [each.title for each in palettes], self._preferences.palette_shown
            place = titles.index(wanted) if wanted in titles else 0
            paper = self._store.state.paper(self._session.document, self._theme)
            self._bar.render_palettes(palettes, place, paper)

    def _show(self, bar: PaletteBar, is_shown: bool) -> None:
        """Show or hide the strip; the canvas gets its size once, with all else that changes."""
        room = self._context.central.under_canvas
        # Qt lays out at once where something is shown, and again when the other panes have changed.
        room.setEnabled(False)
        bar.setVisible(is_shown)
        room.setEnabled(True)
        room.update()

    def _choose(self, place: int) -> None:
        self._preferences.palette_shown = self.palettes[place].title
        self._render()

    @switch(
        "palette",
        "togglePalette",
        "Palette",
        VIEW_MODE,
        "",
        "palette",
        full_name="Show Palette",
        keywords="swatches strip",
    )
    def _toggle(self) -> None:
        """Show colours below the canvas: a click paints the fill, Shift+click the stroke."""

    @action(
        "importPalette",
        "Import Palette…",
        CURVE_STYLE,
        "",
        "import",
        keywords="gpl GIMP swatches colours colors open",
    )
    def _ask_and_import(self) -> None:
        """Offer the colours of a GIMP palette, a file ending in .gpl, below the canvas."""
        folder, kinds = str(self._preferences.last_folder), "GIMP palettes (*.gpl);;All files (*)"
        name, _ = QFileDialog.getOpenFileName(self._context.window, "Import Palette", folder, kinds)
        if name:
            self.import_palette(Path(name).absolute())

    def import_palette(self, path: Path) -> None:
        """Keep where a palette is, and show it; one that is read again takes the place of the first."""
        try:
            palette = _palette_in(path)
        except StorageError as problem:
            self._context.work.refuse(path, "imported", problem)
            return
        others = [each for each in _paths_in(self._preferences.palette_files) if each != path]
        self._preferences.palette_files = json.dumps([*map(str, others), str(path)])
        self._read = ("", ())
        self._preferences.palette_shown = palette.title
        self._preferences.last_folder = path.parent
        self._store.change(palette=True)
        self._render()
        count = count_of(len(palette.swatches), "colour")
        self._session.say(f"Imported {shown(path.name)}: {count}, below the canvas.")


def _palette_in(path: Path) -> Palette:
    title, colours = storage.gimp_palette.read_gimp_palette(path)
    return Palette(title, tuple(Swatch(code, name) for code, name in colours))


def _paths_in(text: str) -> list[Path]:
    """Return the paths that the preferences keep; none of what is no list of them."""
    try:
        names = json.loads(text or "[]")
    except ValueError:
        return []
    return [Path(name) for name in names if isinstance(name, str)] if isinstance(names, list) else []
