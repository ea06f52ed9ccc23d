"""Style of the selected curves: its panel, Swap Fill and Stroke, Copy Style and Paste Style."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec
from PySide6.QtCore import QMimeData
from PySide6.QtWidgets import QWidget

from ... import exchange
from ...actions.declaration import action, also
from ...actions.keymap import key_or_name
from ...actions.menus import CURVE_LIST_MENU, CURVE_MENU, CURVE_STYLE, EDIT_STYLE, WHOLES_MENU
from ...actions.needs import SELECTED_CURVE
from ...appearance.theme import Theme
from ...document.groups import expand_to_shapes
from ...document.model import Curve, Document, make_curve
from ...document.several_curves import STYLE_WORDS, colours_of, name_or_count, set_style, swap_paints
from ...document.style import Style
from ...session.change import why_unsavable
from ...session.session import Session
from ...settings.preferences import Preferences
from ...storage.format_error import FormatError
from ...storage.validation import check_fields
from ...view_model.curve.curve_view import CurveView
from ...view_model.palette import adjustment_of
from ...workbench.clipboard import CURVES, clipboard_data, copied_curves_in, drawing_in, put_on_clipboard
from ...workbench.context import CommandSet, WindowContext
from ...workbench.docks import UPPER, Panel
from ...workbench.form_edits import SliderGesture, cancel_preview
from .. import style

if TYPE_CHECKING:
    from ...exchange.cubics_in import ImportResult
    from .panel import StylePanel


_MOST_REMEMBERED = 12


class UsedColours:
    """Recent colours, and the colours of the document."""

    def __init__(self, session: Session, preferences: Preferences) -> None:
        self._session, self._preferences = session, preferences
        self._document_colours: tuple[tuple[Curve, ...], list[str]] = ((), [])

    @property
    def recent(self) -> list[str]:
        """Recent colours, the latest first."""
        return re.findall("#[0-9a-f]{6}", self._preferences.recent_colours)

    @property
    def in_document(self) -> list[str]:
        """Colours of the document."""
        curves = self._session.committed.curves
        if self._document_colours[0] is not curves:
            self._document_colours = curves, colours_of(curves)
        return self._document_colours[1]

    def remember(self, *paints: object) -> None:
        """Add the colours among some paints to the recent ones."""
        codes = [code for code in paints if isinstance(code, str) and code.startswith("#")]
        if codes:
            recent = list(dict.fromkeys([*codes, *self.recent]))[:_MOST_REMEMBERED]
            self._preferences.recent_colours = " ".join(recent)


_PAINTS = ("fill", "stroke")
_NEXT = "the next curve"
_HOW_TO_CHOOSE = "No curve is selected: this style is for the next curve. Click a curve, or press {} for all."


class StyleCommands:
    """Style of the selected curves, or of the next curve: the panel and its changes."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._dock = context.docks["styleDock"]
        self._panel: StylePanel | None = None
        self._gestures: list[SliderGesture] = []
        self._colours = UsedColours(context.session, context.preferences)
        context.session.selected_curves_changed.connect(self._render)
        context.store.changed.connect(self._render)

    @Panel("styleDock", "Style", UPPER, is_steady=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the form."""
        buttons = [self._context.actions[name] for name in ("copyStyle", "pasteStyle")]
        actions = self._context.actions
        panel = self._panel = style.panel.StylePanel(buttons, actions["swapFillAndStroke"], parent)
        panel.wanted.connect(self._change)
        panel.stepped.connect(partial(self._change, is_step=True))
        panel.previewed.connect(self._preview)
        panel.preview_cancelled.connect(partial(cancel_preview, self._session))
        panel.became_visible.connect(self._render)
        panel.refused.connect(self._session.refuse)
        for name, field in panel.opacities.items():
            edit, words = partial(self._with_share, name), partial(self._words_of_share, name)
            self._gestures.append(SliderGesture(self._session, field.slider, edit, words))
            for moved in (field.slider.dropped, field.slider.chosen):
                moved.connect(partial(self._set_next_share, name))
        for paint in (panel.fill, panel.stroke):
            self._session.gesture_ended.connect(paint.abandon)
        return panel

    # What is shown

    @property
    def _curves(self) -> frozenset[int]:
        """Curves whose style is shown and set; none for the style of the next curve.

        An empty curve counts as the next one.
        """
        session, selected = self._session, self._session.selected
        if selected.marked and not selected.is_implicit:
            return selected.marked
        return frozenset() if session.active_curve.points else frozenset({session.active_index})

    def render_panel(self, view: CurveView) -> None:
        """Show the style of the selected curves."""
        self._render()

    def set_theme(self, theme: Theme) -> None:
        """Update the note about colours on the paper of `theme`."""
        self._render()

    def _render(self, *_: object) -> None:
        panel, session = self._panel, self._session
        if panel is None or not panel.isVisibleTo(self._context.window):
            return
        document, indices = session.document, expand_to_shapes(session.document, self._curves)
        curves = [document.curves[index] for index in sorted(indices)]
        subject = (
            name_or_count(document, indices) if any(curve.points for curve in curves) else _NEXT.capitalize()
        )
        styles = [curve.style for curve in curves] or [session.template_curve.style]
        all_keys = key_or_name(self._context.actions["selectAll"])
        note = (
            _note_on(styles, self._context.central.canvas.layers.theme)
            if curves
            else _HOW_TO_CHOOSE.format(all_keys)
        )
        panel.show_recent(self._colours.recent, self._colours.in_document)
        panel.render_styles(subject, styles, document.unit, note)

    # Changes

    def _change(self, fields: dict[str, object], *, is_step: bool = False) -> None:
        self._colours.remember(*(fields[name] for name in _PAINTS if name in fields))
        self._edit(fields, lambda document, curves: set_style(document, curves, **fields), is_step=is_step)

    def _edit(
        self,
        fields: Iterable[str],
        edit: Callable[[Document, frozenset[int]], Document],
        *,
        is_step: bool = False,
        what: str = "",
    ) -> None:
        """Change the selected curves; the step is named after the fields, or after `what`."""
        session, curves, fields = self._session, self._curves, list(fields)
        if not curves:
            self._set_next(edit)
            return
        if session.is_previewing:
            # Restore the document without the preview, which locked curves may have refused.
            session.cancel()
        run = ("style", curves, *fields) if is_step else None
        change = session.change(self._words(fields, what), lambda document: edit(document, curves), run=run)
        if change.refusal and self._panel is not None:
            self._panel.refuse(change.refusal)
        self._render()

    def _set_next(self, edit: Callable[[Document, frozenset[int]], Document]) -> None:
        """Change the style of the next curve, without a step in the history."""
        session = self._session
        session.cancel()
        model = msgspec.structs.replace(make_curve(()), style=session.template_curve.style)
        before = Document((model,))
        after = edit(before, frozenset({0}))
        if not (refusal := why_unsavable(before, after)):
            session.selected.next_style = after.curves[0].style
        elif self._panel is not None:
            self._panel.refuse(refusal)
        self._render()

    def _words(self, fields: Iterable[str], what: str = "") -> str:
        what = what or " and ".join(STYLE_WORDS[name] for name in fields)
        curves, committed = self._curves, self._session.committed
        return f"{what} of {name_or_count(committed, curves) if curves else _NEXT}"

    def _preview(self, fields: dict[str, object]) -> None:
        session = self._session
        session.preview(set_style(session.committed, self._curves, **fields))

    def _with_share(self, name: str, document: Document, position: int) -> Document:
        return set_style(document, self._curves, **{name: position / style.fields.STEPS})

    def _set_next_share(self, name: str, position: int) -> None:
        if not self._curves:
            self._change({name: position / style.fields.STEPS})

    def _words_of_share(self, name: str, _position: int) -> str:
        return self._words([name])

    # Actions

    @action(
        "showStyle",
        "Stroke and Fill…",
        CURVE_STYLE,
        "Ctrl+Shift+F",
        "palette",
        full_name="Style: Stroke and Fill…",
        keywords="colour width dash opacity line cap join outline",
    )
    @also(CURVE_MENU(23), WHOLES_MENU(40), CURVE_LIST_MENU(14))
    def _show(self) -> None:
        """Set colour, width, ends, corners, dashes and fill of the selected curves."""
        self._dock.bring_up()
        if self._panel is not None:
            self._panel.fill.edit.setFocus()

    @action(
        "swapFillAndStroke",
        "Swap Fill and Stroke",
        CURVE_STYLE,
        "Shift+X",
        "swap",
        full_name="Style: Swap Fill and Stroke",
        keywords="exchange switch colour colors paint outline reverse",
    )
    def _swap(self) -> None:
        """Swap the paints and opacities of fill and stroke."""
        self._edit(_PAINTS, swap_paints, what="Swap fill and stroke")


def _note_on(styles: Iterable[Style], theme: Theme) -> str:
    """Return the note about lines whose colour is adjusted to the paper of a theme."""
    lines = (line_style.stroke for line_style in styles if line_style.has_stroke)
    moved = next(filter(None, (adjustment_of(theme.paper.name(), stroke) for stroke in lines)), "")
    return f"The line is {moved}." if moved else ""


STYLE = "application/x-curvebench-style"
"""MIME type of a style, as JSON."""

_NOTHING_TO_PASTE = "There is no style on the clipboard. Use Copy Style, or copy SVG."


class StyleClipboardCommands(CommandSet):
    """Copy and Paste Style."""

    @action(
        "copyStyle",
        "Copy Style",
        EDIT_STYLE,
        "Ctrl+Alt+Shift+C",
        "style-copy",
        keywords="colour format painter",
        needs=SELECTED_CURVE,
    )
    @also(WHOLES_MENU(41))
    def _copy(self) -> None:
        """Copy stroke and fill of the active curve."""
        session, data = self._session, QMimeData()
        data.setData(STYLE, msgspec.json.encode(session.active_curve.style))
        put_on_clipboard(data)
        session.say(f"Copied the style of “{session.active_curve.display_name}”.")

    @action(
        "pasteStyle",
        "Paste Style",
        EDIT_STYLE,
        "Ctrl+Shift+V",
        "style-paste",
        keywords="colour format painter",
        needs=SELECTED_CURVE,
    )
    @also(WHOLES_MENU(42))
    def _paste(self) -> None:
        """Apply the copied stroke and fill to the selected curves.

        From copied curves or SVG, those of the first one are used.
        """
        data = clipboard_data()
        fragment = None if any(map(data.hasFormat, (STYLE, CURVES))) else drawing_in(data)
        if fragment is not None and not fragment.is_bare:
            read = partial(exchange.svg.fragments.read_fragment, fragment)
            self._context.work.start("Reading the style", read, self._give_first, Path("The style"), "pasted")
        elif pasted_style := _style_in(data):
            self._give(pasted_style)
        else:
            self._session.refuse(_NOTHING_TO_PASTE)

    def _give_first(self, drawing: ImportResult) -> None:
        """Apply the style of the first element of a drawing, in the unit of the document."""
        unit = self._session.document.unit
        self._give(exchange.units.in_unit(drawing.document, unit).curves[0].style)

    def _give(self, copied_style: Style) -> None:
        """Apply a style to the selected curves."""
        session, curves = self._session, self._session.selected.marked
        subject = name_or_count(session.document, curves)
        words = f"Paste style to {subject}"
        fields = msgspec.structs.asdict(copied_style)
        if session.change(words, lambda document: set_style(document, curves, **fields)):
            session.say(f"Pasted the style to {subject}.")


def _style_in(data: QMimeData) -> Style | None:
    """Return the copied style, or that of the first copied curve; None without either."""
    try:
        if data.hasFormat(STYLE):
            copied_style = msgspec.json.decode(bytes(data.data(STYLE).data()), type=Style)
            check_fields(copied_style, "style")
            return copied_style
        if copied := copied_curves_in(data):
            return copied.curves[0].style
    except (msgspec.DecodeError, UnicodeDecodeError, FormatError):
        pass
    return None


COMMAND_SETS = (StyleCommands, StyleClipboardCommands)
