"""Text on the canvas: typed, shown meanwhile, made into curves."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontInfo, QTransform

from ...actions.declaration import action, also
from ...actions.needs import Need
from ...actions.sections import TEXT_WORDS
from ...actions.strips import CHOSEN_MENU
from ...document.content import Lettering
from ...document.contents import corners_of, is_content
from ...document.curve_edits import locked_sentence
from ...document.edits import EditError
from ...document.model import Curve, Document, Vector
from ...document.paper import DocumentKind, kind_of
from ...document.several_curves import remove_curves
from ...document.style import Style
from ...document.text import LONGEST_TEXT, Setting, Text
from ...document.texts import text_around, with_text_known
from ...document.transforms import IDENTITY
from ...exchange.errors import ExchangeError
from ...plotting.printed import to_pixels
from ...qt import glyphs
from ...qt.glyphs import Face
from ...session.session import Session
from ...workbench.context import WindowContext
from .. import text
from .along_commands import AlongCommands
from .flow_commands import FlowCommands
from .outline_commands import OutlineCommands
from .replace_commands import ReplaceCommands
from .type_commands import TypeCommands

_KEYS = "Enter: another line · Ctrl+Enter or a click elsewhere: "


class TextCommands:
    """Asks for the words of a text, shows it as it is typed, and makes a step of it."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._canvas = context.central.canvas
        self._made: text.field.TextField | None = None
        self._place: Vector = (0.0, 0.0)
        # Width and height of the frame that a new text fills, below and to the right of the place.
        self._room: Vector | None = None
        # The text that is edited; None for one that is new.
        self._edited: text.rewriting.Written | text.wording.Worded | None = None
        # What the field said of it when it was opened.
        self._begun: Text | None = None
        self._begun_typed: text.wording.Typed = ()
        # None where letters are curves.
        self._painter: text.letter_paint.LetterPainter | None = None
        self._before = self._session.selected.choice
        self._model = self._session.model
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
            family = preferences.text_font or QFontInfo(self._canvas.font()).family()
            face = Face(family, preferences.text_bold, preferences.text_italic)
            self._made = field = text.field.TextField(self._canvas.viewport(), face, self._context.letters)
            field.changed.connect(self._show)
            field.entered.connect(self._finish)
            field.left.connect(self._make)
            field.given_up.connect(self._give_up)
            self._session.interrupted.connect(self._break_off)
            self._canvas.camera.changed.connect(field.place)
            field.words.keyed.connect(self._reveal_caret)
            field.font_box.picked.connect(partial(text.fonts_before.remember_font, preferences))
            field.size_box.switched.connect(lambda is_on: setattr(preferences, "text_in_points", is_on))
        return self._made

    @property
    def _is_drawing(self) -> bool:
        return kind_of(self._session.committed) is DocumentKind.DRAWING

    @property
    def _is_open(self) -> bool:
        return self._made is not None and not self._made.isHidden()

    def _begin(self, place: Vector, opposite: Vector | None = None) -> None:
        """Ask for the words of a text at a place, or in a frame from there to the opposite corner."""
        if self._has_fonts():
            self._edited = self._painter = None
            self._room = None if opposite is None else (opposite[0] - place[0], place[1] - opposite[1])
            self.field.set_setting(self._setting)
            size = self._size or text.first_size.first_size(
                self._canvas.pixel_map, self._session.committed.page
            )
            self.field.begin_new(size, has_parts=self._is_drawing)
            if self._is_drawing:
                self._paint_in(self._session.model.style, 1.0)
            self._open(place, size)

    @action(
        "editText",
        "Edit Text",
        TEXT_WORDS,
        needs=Need("a text, or letters of one", lambda now: _letter_meant(now.session) >= 0),
        keywords="words letters font size type typo",
    )
    @also(CHOSEN_MENU(2))
    def _edit(self) -> None:
        """Change words, font or size of the text that the chosen letters are of."""
        self._begin_again(_letter_meant(self._session))

    def _begin_again(self, curve: int, clicked: Vector | None = None) -> None:
        """Ask for other words of the text that a curve is a letter of, typed where it was clicked."""
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
        self._edited, self._begun, self._room = written, None, None
        if isinstance(written, text.wording.Worded):
            self.field.begin_again(written.typed, written.scale, written.face)
            self._paint_in(session.committed.curves[curve].style, written.scale)
        else:
            self._painter = None
            self.field.begin_with(written.text.words, written.face)
        self.field.set_setting(written.text.setting)
        self._open((written.text.x, written.text.y), written.text.size)
        if clicked is not None:
            self.field.words.stand_at_place(clicked)

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
        self.field.setting_row.set_in_frame(self._fills_frame)
        self._before, self._model = self._session.selected.choice, self._session.model
        # Nobody edits a curve while writing.
        self._session.selected.choose(())
        self.field.font_box.offer_first(
            text.fonts_before.fonts_first(self._session.committed, self._context.preferences)
        )
        self.field.size_box.show_unit(
            self._session.document.unit, wants_points=self._context.preferences.text_in_points
        )
        self.field.open_beside(self._way_to_pixels, size)
        self._begun, self._begun_typed = self._text, self._typed
        if self._painter is not None:
            self._context.letters.begin(self._painter)
        self._show()
        kept = "keeps the text, as Escape does" if self._is_text else "makes its shapes · Escape gives it up"
        self._session.say(f"{_KEYS}{kept}.")

    def _way_to_pixels(self) -> QTransform:
        origin = self._canvas.camera.origin
        return to_pixels(self._canvas.pixel_map) * QTransform.fromTranslate(origin.x(), origin.y())

    def _reveal_caret(self) -> None:
        if self._is_open:
            place = self.field.words.caret.center() - self._canvas.camera.origin
            self._canvas.framing.reveal(place.x(), place.y())

    # Preview

    def _show(self) -> None:
        """Show the text as it is typed."""
        if not self._is_open:
            return
        field, session = self.field, self._session
        self._outlines = glyphs.outlines_of(field.text[: self._most], field.face, field.setting)
        if self._edited is None:
            self._size, self._setting = field.size_box.em, field.setting_row.setting
        field.remark(
            text.remarks.of_typed(field, self._outlines, self._most) or text.remarks.of_edited(self._edited)
        )
        try:
            # Under one name all the while, so that the letters before the one that is typed stay the same.
            shown, places = self._written("Text") if self._is_another else (None, range(0))
        except (ExchangeError, EditError) as reason:
            self._outlines, shown, places = glyphs.NO_OUTLINES, None, range(0)
            field.remark(str(reason))
        if shown is None:
            places = self._edited.places if self._edited is not None else places
            session.cancel()
        else:
            session.preview(text.rewriting.with_curves_of(shown, session.document))
        # With its sides, to see what is filled.
        session.selected.show_choice(places if self._fills_frame else ())
        self._lay_words((shown or session.committed).curves[_slice(places)])

    def _lay_words(self, curves: Sequence[Curve]) -> None:
        """Have the words typed where they are drawn, as curves; where the first will be, as none."""
        edited, now, typed = self._edited, self._text, self._typed
        if not self._is_text:
            places = text.caret.in_outlines(
                now, edited.by if isinstance(edited, text.rewriting.Written) else IDENTITY
            )
        elif edited is not None and self._begun is not None:
            before = self._session.committed.curves[edited.places.start]
            curves = curves or (before,)
            places = text.caret.in_shown(curves[0], before, self._begun, now, typed)
        elif self._room is None:
            places = text.caret.in_new(now, typed)
        elif curves:
            places = text.caret.in_frame(curves[0])
        else:
            places = text.caret.in_new_frame(now, typed, self._room)
        if curves and (unseen := text.remarks.of_shown(curves[0])):
            self.field.remark(unseen)
        self.field.lie_at(places, corners_of(curves[0]) if curves and self._fills_frame else ())

    @property
    def _fills_frame(self) -> bool:
        if not isinstance(self._edited, text.wording.Worded):
            return self._edited is None and self._room is not None
        form = self._session.committed.curves[self._edited.places.start].form
        return isinstance(form, Lettering) and form.flow is not None

    @property
    def _most(self) -> int:
        """Letters that a text may have."""
        return text.wording.LONGEST_WORDS if self._is_text else LONGEST_TEXT

    @property
    def _is_text(self) -> bool:
        """Whether it stays one."""
        edited = self._edited
        return self._is_drawing if edited is None else isinstance(edited, text.wording.Worded)

    @property
    def _text(self) -> Text:
        """What is typed, and where."""
        field, face, (x, y) = self.field, self.field.face, self._place
        words = field.text[: self._most]
        text = Text(words, face.family, x, y, field.size_box.em, face.bold, face.italic)
        return replace(text, **field.setting._asdict())

    @property
    def _typed(self) -> text.wording.Typed:
        """The letters, each as it looks."""
        return text.wording.cut(self.field.typed, self._most)

    def _looks(self, style: Style) -> tuple[Style, text.wording.Typed]:
        """Return the style of the text, and its letters with what they have for themselves."""
        return (style, self._typed) if self._painter is None else self._painter.looks(self._typed)

    def _written(self, name: str) -> tuple[Document, range]:
        """Return the document with the text, and the places of its curves; without one that is emptied."""
        session = self._session
        if self._edited is not None and self._is_emptied:
            return remove_curves(session.committed, self._edited.places), range(0)
        if isinstance(self._edited, text.wording.Worded) and self._begun is not None:
            style, typed = self._looks(session.committed.curves[self._edited.places.start].style)
            return text.wording.reworded(
                session.committed, self._edited, self._begun, self._text, typed, style
            )
        if isinstance(self._edited, text.rewriting.Written):
            return text.rewriting.rewritten(session.committed, self._edited, self._text, self._outlines)
        if kind_of(session.committed) is DocumentKind.DRAWING:
            style, typed = self._looks(self._model.style)
            return text.wording.with_worded(
                session.committed, style, self._text, typed, session.selected.layer, self._room
            )
        return text.letters.with_text(
            session.committed, self._model, name, self._outlines, self._text, session.selected.layer
        )

    # The end

    def _finish(self) -> None:
        """Make the text, by Ctrl+Enter."""
        self._make()
        self._canvas.setFocus(Qt.FocusReason.OtherFocusReason)

    def _make(self) -> None:
        """Make the text, if there is any and it is another one."""
        name, face, edited, known = (
            text.letters.name_of_text(self.field.text), self.field.face, self._edited, self._text
        )  # fmt: skip
        made = self._written(name) if self._is_another else None
        self._close()
        if made is None:
            self._session.cancel()
            self._session.selected.restore(self._before)
            return
        document, places = made
        if edited is not None and not places:
            name = text.letters.name_of_text(edited.text.words)
            self._session.change(f"Delete Text “{name}”", lambda _: document)
            return
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
    def _is_emptied(self) -> bool:
        return self._edited is not None and not self.field.text.strip()

    @property
    def _is_another(self) -> bool:
        """Whether there is anything to show that is not there."""
        return bool(self._outlines.glyphs or self._is_emptied) and not self._is_as_it_was

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
        """Go back to what was, by Escape; in a drawing a text stays as it is, and undo takes that back."""
        if not isinstance(self._edited, text.rewriting.Written) and self._is_drawing:
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


def _slice(places: range) -> slice:
    return slice(places.start, places.stop)


COMMAND_SETS = (TextCommands, TypeCommands, ReplaceCommands, OutlineCommands, AlongCommands, FlowCommands)
