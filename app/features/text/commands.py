"""Text on the canvas: typed, shown meanwhile, made into curves."""

from __future__ import annotations

from itertools import chain, repeat

from msgspec.structs import replace
from PySide6.QtCore import QPoint, QRect, Qt

from ...actions.declaration import action, also
from ...actions.needs import Need
from ...actions.sections import CURVE_NAME
from ...actions.strips import CHOSEN_MENU
from ...document.contents import is_content
from ...document.curve_edits import locked_sentence
from ...document.edits import EditError
from ...document.model import Document, Vector
from ...document.paper import DocumentKind, kind_of
from ...document.style import Style
from ...document.text import LONGEST_TEXT, Setting, Text
from ...document.texts import text_around, with_text_known
from ...document.transforms import clean_step_within
from ...document.words import enumerated
from ...exchange.errors import ExchangeError
from ...qt import glyphs
from ...qt.glyphs import Face, Outlines
from ...session.session import Session
from ...workbench.context import WindowContext
from .. import text
from .outline_commands import OutlineCommands

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
        # The text that is edited; None for one that is new.
        self._edited: text.rewriting.Written | text.wording.Worded | None = None
        # What the field said of it when it was opened.
        self._begun: Text | None = None
        self._begun_typed: text.wording.Typed = ()
        # None where letters are curves.
        self._painter: text.letter_paint.LetterPainter | None = None
        self._before = self._session.selected.choice
        self._model = self._session.model
        # Left, bottom and top of its letters.
        self._box = (0.0, 0.0, 0.0)
        # The size that was used last in this document, None before; and how its letters stood.
        self._size: float | None = None
        self._setting = Setting()
        self._outlines = glyphs.NO_OUTLINES
        self._canvas.text_placed.connect(self._begin)
        self._canvas.text_opened.connect(self._begin_again)
        self._session.opened.connect(self._forget_size)

    def _forget_size(self) -> None:
        self._size, self._setting = None, Setting()

    @property
    def field(self) -> text.field.TextField:
        """The field on the canvas; made when somebody first types into it."""
        if self._made is None:
            preferences = self._context.preferences
            family = preferences.text_font or self._canvas.font().family()
            face = Face(family, preferences.text_bold, preferences.text_italic)
            self._made = field = text.field.TextField(self._canvas.viewport(), face, self._context.letters)
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

    def _begin(self, place: Vector) -> None:
        """Ask for the words of a text at a place."""
        if self._has_fonts():
            self._edited = self._painter = None
            self.field.set_setting(self._setting)
            size = self._size or clean_step_within(self._view_height * _SHARE)
            is_drawing = kind_of(self._session.committed) is DocumentKind.DRAWING
            self.field.begin_new(size, has_parts=is_drawing)
            if is_drawing:
                self._paint_in(text.letters.filled(self._session.model.style), 1.0)
            self._open(place, size)

    @action(
        "editText",
        "Edit Text",
        CURVE_NAME,
        needs=Need("a text, or letters of one", lambda now: _letter_meant(now.session) >= 0),
        keywords="words letters font size type typo",
    )
    @also(CHOSEN_MENU(2))
    def _edit(self) -> None:
        """Change words, font or size of the text that the chosen letters are of."""
        self._begin_again(_letter_meant(self._session))

    def _begin_again(self, curve: int) -> None:
        """Ask for other words of the text that a curve is a letter of."""
        session = self._session
        if not self._has_fonts():
            return
        written: text.rewriting.Written | text.wording.Worded | None
        try:
            written = text.wording.worded_at(session.committed, curve)
        except EditError as reason:
            session.refuse(str(reason))
            return
        written = written or text.rewriting.written_at(session.committed, curve)
        if written is None:
            return
        if locked := [each.name for each in session.committed.curves[_slice(written.places)] if each.locked]:
            session.refuse(locked_sentence(locked))
            return
        self._edited, self._begun = written, None
        if isinstance(written, text.wording.Worded):
            self.field.begin_again(written.typed, written.scale, written.face)
            self._paint_in(session.committed.curves[curve].style, written.scale)
        else:
            self._painter = None
            self.field.begin_with(written.text.words, written.face)
        self.field.set_setting(written.text.setting)
        self._open((written.text.x, written.text.y), written.text.size)

    def _paint_in(self, style: Style, scale: float) -> None:
        """Let colours be chosen for letters of a text in a style, a unit of which is so long."""
        self._painter = text.letter_paint.LetterPainter(self.field, style, scale)

    def _has_fonts(self) -> bool:
        if glyphs.has_fonts():
            return True
        self._session.refuse("There are no fonts on this computer, and so no letters.")
        return False

    def _open(self, place: Vector, size: float) -> None:
        self._place = place
        self._before, self._model = self._session.selected.choice, self._session.model
        # Nobody edits a curve while writing.
        self._session.selected.choose(())
        self.field.open_beside(self._area, size, self._session.document.unit)
        self._begun, self._begun_typed = self._text, self._typed
        if self._painter is not None:
            self._context.letters.begin(self._painter)
        self._show()

    @property
    def _view_height(self) -> float:
        _, bottom, _, top = self._canvas.pixel_map.box
        return top - bottom

    def _area(self) -> QRect:
        """Return what the text takes of the canvas, about."""
        (x, y), size = self._place, self.field.text_size
        lines = self.field.text.count("\n") * _LINE * self.field.setting.line_spacing
        low, high = y - (_DESCENT + lines) * size, y + _ASCENT * size
        if self._edited is not None:
            # It may be turned.
            x, low, high = self._box
        top, bottom = self._canvas.to_pixel(x, high), self._canvas.to_pixel(x, low)
        return QRect(top, QPoint(top.x() + 1, bottom.y()))

    def _follow_view(self) -> None:
        if self._is_open:
            self.field.place()

    # Preview

    def _show(self) -> None:
        """Show the text as it is typed."""
        field, session = self.field, self._session
        self._outlines = glyphs.outlines_of(field.text[:LONGEST_TEXT], field.face, field.setting)
        if self._edited is None:
            self._size, self._setting = field.text_size, field.setting
        field.remark(_remark(field, self._outlines) or _remark_of(self._edited))
        try:
            # Under one name all the while, so that the letters before the one that is typed stay the same.
            has_any = self._outlines.glyphs and not self._is_as_it_was
            shown, places = self._written("Text") if has_any else (None, range(0))
        except (ExchangeError, EditError) as reason:
            self._outlines, shown, places = glyphs.NO_OUTLINES, None, range(0)
            field.remark(str(reason))
        if self._edited is not None:
            self._note_box(shown or session.committed, places or self._edited.places)
        if shown is None:
            session.cancel()
        else:
            session.preview(_with_curves_of(shown, session.document))
            session.selected.show_choice(())

    def _note_box(self, document: Document, places: range) -> None:
        points = [point for curve in document.curves[_slice(places)] for point in curve.points]
        if points:
            heights = [point.y for point in points]
            self._box = (min(point.x for point in points), min(heights), max(heights))
            self.field.place()

    @property
    def _text(self) -> Text:
        """What is typed, and where."""
        field, face, (x, y) = self.field, self.field.face, self._place
        words = field.text[:LONGEST_TEXT]
        text = Text(words, face.family, x, y, field.text_size, face.bold, face.italic)
        return replace(text, **field.setting._asdict())

    @property
    def _typed(self) -> text.wording.Typed:
        """The letters, each as it looks."""
        return text.wording.cut(self.field.typed, LONGEST_TEXT)

    def _looks(self, style: Style) -> tuple[Style, text.wording.Typed]:
        """Return the style of the text, and its letters with what they have for themselves."""
        return (style, self._typed) if self._painter is None else self._painter.looks(self._typed)

    def _written(self, name: str) -> tuple[Document, range]:
        """Return the document with the text, and the places of its curves."""
        session = self._session
        if isinstance(self._edited, text.wording.Worded) and self._begun is not None:
            style, typed = self._looks(session.committed.curves[self._edited.places.start].style)
            return text.wording.reworded(
                session.committed, self._edited, self._begun, self._text, typed, style
            )
        if isinstance(self._edited, text.rewriting.Written):
            return text.rewriting.rewritten(session.committed, self._edited, self._text, self._outlines)
        if kind_of(session.committed) is DocumentKind.DRAWING:
            style, typed = self._looks(text.letters.filled(self._model.style))
            return text.wording.with_worded(
                session.committed, style, self._text, typed, session.selected.layer
            )
        return text.letters.with_text(
            session.committed, self._model, name, self._outlines, self._text, session.selected.layer
        )

    # The end

    def _finish(self) -> None:
        """Make the text, by Enter."""
        self._make()
        self._canvas.setFocus(Qt.FocusReason.OtherFocusReason)

    def _make(self) -> None:
        """Make the text, if there is any and it is another one."""
        name, face, edited, known = (
            text.letters.name_of_text(self.field.text), self.field.face, self._edited, self._text
        )  # fmt: skip
        made = self._written(name) if self._outlines.glyphs and not self._is_as_it_was else None
        self._close()
        if made is None:
            self._session.cancel()
            self._session.selected.restore(self._before)
            return
        document, places = made
        is_text = is_content(document.curves[places.start])
        document = document if is_text else with_text_known(document, places, known)
        verb = "Add" if edited is None else "Edit"
        if not self._session.change(f"{verb} Text “{name}”", lambda _: document, active=places.start):
            return
        self._session.selected.choose(places)
        if isinstance(edited, text.wording.Worded):
            return
        again = "a double click with the arrow (V) edits the text again"
        self._session.say(
            f"A{again[1:]}; Object to Path makes outlines of it."
            if is_text
            else f"The letters are chosen, and curves now; {again}."
        )
        self._remember(face)

    @property
    def _is_as_it_was(self) -> bool:
        """Whether the text that is edited is the same still, and tells what its letters are."""
        edited = self._edited
        if isinstance(edited, text.wording.Worded):
            is_set = self._begun is not None and self.field.setting == self._begun.setting
            is_styled = self._painter is not None and not self._painter.is_as_it_was
            return is_set and not is_styled and self._typed == self._begun_typed
        if edited is None or edited.is_changed:
            return False
        return self._text == edited.text

    def _remember(self, face: Face) -> None:
        preferences = self._context.preferences
        preferences.text_font = face.family
        preferences.text_bold, preferences.text_italic = face.bold, face.italic

    def _give_up(self) -> None:
        """Go back to what was, by Escape; what is new in a drawing stays, and undo takes it away."""
        if self._edited is None and kind_of(self._session.committed) is DocumentKind.DRAWING:
            self._finish()
            return
        self._close()
        self._session.cancel()
        self._session.selected.restore(self._before)
        self._canvas.setFocus(Qt.FocusReason.OtherFocusReason)

    def _break_off(self) -> None:
        """Something else changes the document: the next click goes on with the words."""
        if self._is_open:
            self._close(keeps_words=self._edited is None)

    def _close(self, *, keeps_words: bool = False) -> None:
        self._context.letters.end()
        self.field.close_field(keeps_words=keeps_words)
        self._outlines = glyphs.NO_OUTLINES


def _letter_meant(session: Session) -> int:
    """Return the place of a letter of the text that is meant; −1 for none, or where there is more."""
    meant = session.selected.highlight(whole_curves=True).curves
    first = min(meant, default=-1)
    return first if first >= 0 and meant <= {*text_around(session.document, first)} else -1


def _remark(field: text.field.TextField, outlines: Outlines) -> str:
    if len(field.text) > LONGEST_TEXT:
        return f"A text has at most {LONGEST_TEXT} letters; the rest is left out."
    if outlines.missing:
        return f"No font here has {enumerated([f'“{each}”' for each in outlines.missing[:5]])}."
    return f"“{field.face.family}” has no bold letters." if outlines.lacks_bold else ""


def _remark_of(edited: text.rewriting.Written | text.wording.Worded | None) -> str:
    """Say what of a text that is edited is not as it was written."""
    if edited is None or not edited.is_changed:
        return ""
    if not glyphs.has_family(edited.text.font):
        return f"“{edited.text.font}” is not on this computer; Enter writes the text in another font."
    return "The letters were changed by hand; Enter writes them anew at this place."


def _slice(places: range) -> slice:
    return slice(places.start, places.stop)


def _with_curves_of(document: Document, shown: Document) -> Document:
    """Return the document, of the curves that are shown already the very same: their views are there."""
    before = chain(shown.curves, repeat(None))
    return replace(
        document,
        curves=tuple(old if old == new else new for new, old in zip(document.curves, before, strict=False)),
    )


COMMAND_SETS = (TextCommands, OutlineCommands)
