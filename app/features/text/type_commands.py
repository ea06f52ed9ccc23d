"""Font and size of all texts that are chosen."""

from __future__ import annotations

from contextlib import suppress
from functools import partial

from msgspec.structs import replace
from PySide6.QtCore import Qt

from ...actions.declaration import action, also
from ...actions.needs import Need
from ...actions.sections import TEXT_WORDS
from ...actions.strips import CHOSEN_MENU
from ...document.content import TextRun
from ...document.contents import corners_of, plane_of, texts_at
from ...document.limits import EditError
from ...document.several_curves import changeable, named
from ...qt.glyphs import Face
from ...session.session import Session
from ...workbench.context import WindowContext
from .. import text


def _texts(session: Session) -> list[int]:
    return [*texts_at(session.document, session.selected.marked)]


class TypeCommands:
    """Asks for the font and the size of texts beside them, and sets both."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._made: text.type_bar.TypeBar | None = None

    @action(
        "textAndFont",
        "Font and Size…",
        TEXT_WORDS,
        key="Ctrl+Shift+T",
        icon="type",
        needs=Need("a text", lambda now: bool(_texts(now.session))),
        keywords="text family typeface bold italic points letters several all",
    )
    @also(CHOSEN_MENU(3))
    def _open(self) -> None:
        """Set font and size of all texts that are chosen, words and places as they are."""
        bar = self._bar
        bar.size_box.show_unit(
            self._session.document.unit, wants_points=self._context.preferences.text_in_points
        )
        bar.font_box.offer_first(
            text.fonts_before.fonts_first(self._session.committed, self._context.preferences)
        )
        bar.show()
        bar.raise_()
        self._follow()
        bar.font_box.setFocus(Qt.FocusReason.ShortcutFocusReason)

    @property
    def _bar(self) -> text.type_bar.TypeBar:
        if self._made is None:
            canvas, session = self._context.central.canvas, self._session
            self._made = bar = text.type_bar.TypeBar(canvas.viewport(), canvas.font().family())
            bar.font_asked.connect(lambda family: self._set("Font", _in_font(family)))
            bar.font_looked_at.connect(self._look_at)
            bar.switched.connect(self._switch)
            bar.sized.connect(lambda size: self._set("Size", partial(_sized, size)))
            bar.font_asked.connect(partial(text.fonts_before.remember_font, self._context.preferences))
            bar.closed.connect(self._close)
            bar.size_box.switched.connect(self._remember_unit)
            session.selected_curves_changed.connect(self._follow)
            session.history_changed.connect(self._follow)
        return self._made

    def _remember_unit(self, in_points: bool) -> None:
        self._context.preferences.text_in_points = in_points

    def _follow(self, *_: object) -> None:
        """Show what is chosen now; without a text there is nothing to ask."""
        bar, session = self._bar, self._session
        if bar.isHidden() or session.is_previewing:
            return
        texts = texts_at(session.document, session.selected.marked)
        if not texts:
            bar.hide()
            return
        curves = session.document.curves
        runs = [
            (run, run.size * plane_of(form, corners_of(curves[at])).scale)
            for at, form in texts.items()
            for line in form.lines
            for run in line.runs
        ]
        faces = [
            Face(run.font[0] if run.font else "", run.weight >= text.wording.BOLD, run.italic)
            for run, _ in runs
        ]
        # The last digits of a product are noise.
        sizes = [float(f"{size:.9g}") for _, size in runs]
        bar.show_texts(named(session.document, frozenset(texts)), faces, sizes)

    def _look_at(self, family: str) -> None:
        session = self._session
        session.cancel()
        if family:
            places = changeable(session.committed, _texts(session))
            with suppress(EditError):
                session.preview(text.wording.restyled(session.committed, places, _in_font(family)))

    def _switch(self, name: str, is_on: bool) -> None:
        fields = {"weight": text.wording.WEIGHTS[is_on]} if name == "bold" else {name: is_on}
        self._set(name.capitalize(), lambda run, _: replace(run, **fields))

    def _set(self, words: str, change: text.wording.Restyle) -> None:
        session = self._session
        places = changeable(session.committed, _texts(session))
        session.change(
            f"{words}: {named(session.committed, places)}",
            lambda document: text.wording.restyled(document, places, change),
            active=None,
        )

    def _close(self) -> None:
        self._bar.hide()
        self._context.central.canvas.setFocus(Qt.FocusReason.OtherFocusReason)


def _in_font(family: str) -> text.wording.Restyle:
    return lambda run, _: replace(run, font=(family,))


def _sized(size: float, run: TextRun, scale: float) -> TextRun:
    return run.resized(size / (run.size * scale))
