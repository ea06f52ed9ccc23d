"""Text on the canvas: typed, shown meanwhile, made into curves."""

from __future__ import annotations

from itertools import chain, repeat

from msgspec.structs import replace
from PySide6.QtCore import QPoint, QRect, Qt

from ...document.edits import EditError
from ...document.model import Document, Vector
from ...document.transforms import clean_step_within
from ...document.words import enumerated
from ...exchange.errors import ExchangeError
from ...qt import glyphs
from ...qt.glyphs import Face, Outlines
from ...workbench.context import WindowContext
from .. import text

_LONGEST = 300
_SHARE = 1 / 8
"""Of the height of the view, for the size of the first text."""
_ASCENT, _DESCENT, _LINE = 0.8, 0.3, 1.2
"""About what a line takes of an em above and below its baseline, and how far the next one is."""


class TextCommands:
    """Asks for the words of a text, shows it as it is typed, and makes a step of it."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._canvas = context.central.canvas
        self._made: text.field.TextField | None = None
        self._place: Vector = (0.0, 0.0)
        self._before = self._session.selected.choice
        self._model = self._session.model
        # The size that was used last in this document; None before.
        self._size: float | None = None
        self._outlines = glyphs.NO_OUTLINES
        self._canvas.text_placed.connect(self._open)
        self._session.opened.connect(self._forget_size)

    def _forget_size(self) -> None:
        self._size = None

    @property
    def field(self) -> text.field.TextField:
        """The field on the canvas; made when somebody first types into it."""
        if self._made is None:
            preferences = self._context.preferences
            family = preferences.text_font or self._canvas.font().family()
            face = Face(family, preferences.text_bold, preferences.text_italic)
            self._made = field = text.field.TextField(self._canvas.viewport(), face)
            field.changed.connect(self._show)
            field.entered.connect(self._finish)
            field.left.connect(self._make)
            field.given_up.connect(self._give_up)
            self._session.interrupted.connect(self._break_off)
            self._canvas.camera.changed.connect(self._follow_view)
        return self._made

    @property
    def _is_open(self) -> bool:
        return self._made is not None and not self._made.isHidden()

    def _open(self, place: Vector) -> None:
        if not glyphs.has_fonts():
            self._session.refuse("There are no fonts on this computer, and so no letters.")
            return
        self._place = place
        self._before, self._model = self._session.selected.choice, self._session.model
        # Nobody edits a curve while writing.
        self._session.selected.choose(())
        size = self._size or clean_step_within(self._view_height * _SHARE)
        self.field.open_beside(self._area, size, self._session.document.unit)
        self._show()

    @property
    def _view_height(self) -> float:
        _, bottom, _, top = self._canvas.pixel_map.box
        return top - bottom

    def _area(self) -> QRect:
        """Return what the text takes of the canvas, about."""
        (x, y), size = self._place, self.field.text_size
        lines = self.field.text.count("\n")
        top = self._canvas.to_pixel(x, y + _ASCENT * size)
        bottom = self._canvas.to_pixel(x, y - (_DESCENT + lines * _LINE) * size)
        return QRect(top, QPoint(top.x() + 1, bottom.y()))

    def _follow_view(self) -> None:
        if self._is_open:
            self.field.place()

    # Preview

    def _show(self) -> None:
        """Show the text as it is typed."""
        field, session = self.field, self._session
        self._size, self._outlines = field.text_size, glyphs.outlines_of(field.text[:_LONGEST], field.face)
        field.remark(_remark(field, self._outlines))
        try:
            # Under one name all the while, so that the letters before the one that is typed stay the same.
            shown, _ = self._written("Text") if self._outlines.glyphs else (None, range(0))
        except (ExchangeError, EditError) as reason:
            self._outlines, shown = glyphs.NO_OUTLINES, None
            field.remark(str(reason))
        if shown is None:
            session.cancel()
        else:
            session.preview(_with_curves_of(shown, session.document))
            session.selected.show_choice(())

    def _written(self, name: str) -> tuple[Document, range]:
        """Return the document with the text, and the places of its curves."""
        session, size = self._session, self.field.text_size
        return text.letters.with_text(
            session.committed,
            self._model,
            name,
            self._outlines,
            self._place,
            size,
            session.selected.layer,
        )

    # The end

    def _finish(self) -> None:
        """Make the text, by Enter."""
        self._make()
        self._canvas.setFocus(Qt.FocusReason.OtherFocusReason)

    def _make(self) -> None:
        """Make the text, if there is any."""
        name, face = text.letters.name_of_text(self.field.text), self.field.face
        made = self._written(name) if self._outlines.glyphs else None
        self._close()
        if made is None:
            self._session.selected.restore(self._before)
            return
        document, places = made
        if not self._session.change(f"Add Text “{name}”", lambda _: document, active=places.start):
            return
        self._session.selected.choose(places)
        self._session.say(
            "The letters are chosen, and curves from now on; V takes the arrow to move and edit them."
        )
        self._remember(face)

    def _remember(self, face: Face) -> None:
        preferences = self._context.preferences
        preferences.text_font = face.family
        preferences.text_bold, preferences.text_italic = face.bold, face.italic

    def _give_up(self) -> None:
        self._close()
        self._session.cancel()
        self._session.selected.restore(self._before)
        self._canvas.setFocus(Qt.FocusReason.OtherFocusReason)

    def _break_off(self) -> None:
        """Something else changes the document: the next click goes on with the words."""
        if self._is_open:
            self._close(keeps_words=True)

    def _close(self, *, keeps_words: bool = False) -> None:
        self.field.close_field(keeps_words=keeps_words)
        self._outlines = glyphs.NO_OUTLINES


def _remark(field: text.field.TextField, outlines: Outlines) -> str:
    if len(field.text) > _LONGEST:
        return f"A text has at most {_LONGEST} letters; the rest is left out."
    if outlines.missing:
        return f"No font here has {enumerated([f'“{each}”' for each in outlines.missing[:5]])}."
    return f"“{field.face.family}” has no bold letters." if outlines.lacks_bold else ""


def _with_curves_of(document: Document, shown: Document) -> Document:
    """Return the document, of the curves that are shown already the very same: their views are there."""
    before = chain(shown.curves, repeat(None))
    return replace(
        document,
        curves=tuple(old if old == new else new for new, old in zip(document.curves, before, strict=False)),
    )


COMMAND_SETS = (TextCommands,)
