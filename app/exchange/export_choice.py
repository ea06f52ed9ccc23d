"""A person's choice of format and options for an export: as JSON, and as options of the writers."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import msgspec

from ..document.groups import expand_to_shapes
from ..document.lengths import known_unit
from ..document.model import Document, Export, Paper
from ..document.several_curves import common_name, extract_curves
from .drawing.styles import DARK, LIGHT, ON_PAPER, PictureStyle
from .formats import FORMATS, Format
from .options import (
    BASIS,
    BY_DPI,
    DARK_PAPER,
    EXTENT,
    TRANSPARENT,
    TRUE_SIZE,
    Extent,
    Option,
    Options,
    Value,
    all_options,
)


@dataclass(frozen=True)
class ExportChoice:
    """A format and the values of all formats' options.

    Attributes
    ----------
    ending
        Ending of the format.
    values
        Values other than the defaults, by the options' names.
    """

    ending: str = ".png"
    values: Mapping[str, Any] = field(default_factory=dict)

    def __getitem__(self, option: Option[Value]) -> Value:
        """Return the value of an option."""
        value: Value = self.values.get(option.name, option.default)
        return value

    @property
    def format(self) -> Format:
        """The record of the format."""
        return next(form for form in FORMATS.written if form.ending == self.ending)

    def of_selected(self) -> ExportChoice:
        """Return the same choice for the selected curves only."""
        return ExportChoice(self.ending, {**self.values, EXTENT.name: Extent.SELECTED})

    def style_on(self, paper: Paper) -> PictureStyle | None:
        """Return the colours of a picture of a document with that paper; None for dark ink without any."""
        dark = self[DARK_PAPER]
        if dark is None and paper in ON_PAPER:
            return ON_PAPER[paper]
        return DARK if dark else None if self[TRANSPARENT] else LIGHT

    def relevant_options(self, unit: str = "", paper: Paper = Paper.THEME) -> tuple[Option[Any], ...]:
        """Return the options of the format that have an effect with these values, that unit and paper."""
        options = self.format.options
        values = {option.name: self[option] for option in options}
        values[BY_DPI.name] = self[BY_DPI] if known_unit(unit) else None
        hidden = [*self.format.hidden(values), *([] if known_unit(unit) else [TRUE_SIZE])]
        if self[DARK_PAPER] is None and paper is not Paper.THEME:
            hidden.append(TRANSPARENT)
        return tuple(option for option in options if option not in hidden)

    def request(
        self, document: Document, active: int, selected: Collection[int] = (), *, with_estimates: bool = False
    ) -> ExportRequest:
        """Return the part of a document to write, and the options of its writer.

        Parameters
        ----------
        active
            Index of the active curve.
        selected
            The selected curves, if any.
        with_estimates
            Whether the basis panel shows what each point does with its estimates.
        """
        unit = document.unit
        values = {option.name: self[option] for option in self.format.options}
        is_picture = values.pop(DARK_PAPER.name, self) is not self
        has_basis = values.pop(BASIS.name, False)
        shared = {name: values.pop(name) for name in Options.__struct_fields__ if name in values}
        values.pop(BY_DPI.name, None)
        if values.pop(TRUE_SIZE.name, True) is False:
            unit = ""
        matters = {option.name for option in self.relevant_options(document.unit, document.paper)}
        part, active = _part_of(document, self[EXTENT], active, selected)
        options = Options(
            **{name: value for name, value in shared.items() if name in matters},
            style=self.style_on(document.paper) if is_picture else None,
            basis=active if has_basis else None,
            with_estimates=with_estimates,
            unit=unit,
            format_options=values,
            from_corner=self[EXTENT] is Extent.SELECTED,
        )
        return ExportRequest(part, options)


class ExportRequest(NamedTuple):
    """A document to be written, with the options of its writer."""

    document: Document
    options: Options


def _part_of(
    document: Document, extent: Extent, active: int, selected: Collection[int]
) -> tuple[Document, int]:
    """Return the part of a document to export, and the index of the active curve in it."""
    if extent is Extent.SELECTED:
        indices = sorted(expand_to_shapes(document, selected or (active,)))
        return extract_curves(document, indices), indices.index(active) if active in indices else 0
    return document, active


def choice_from(text: str) -> ExportChoice:
    """Return the choice that was stored as JSON, with defaults for values that cannot be used."""
    try:
        remembered = msgspec.json.decode(text or "{}", type=dict[str, Any])
    except (msgspec.DecodeError, UnicodeError):
        return ExportChoice()
    return _usable(remembered.get("ending"), remembered)


def choice_of(export: Export) -> ExportChoice | None:
    """Return the choice that a document was exported with; None if it never was."""
    if not export.ending:
        return None
    values = {}
    for name, text in export.options:
        with suppress(msgspec.DecodeError, UnicodeError):
            values[name] = msgspec.json.decode(text)
    return _usable(export.ending, values)


def suggested_name(choice: ExportChoice, document: Document, selected: Collection[int], last: Export) -> str:
    """Return the name of the exported curves or of the last export, without ending; empty for neither."""
    if choice[EXTENT] is Extent.SELECTED:
        return common_name(document, expand_to_shapes(document, selected)) or ""
    return last.name.removesuffix(last.ending) if last.ending == choice.ending else ""


def export_record(choice: ExportChoice, name: str, last: Export) -> Export:
    """Return the record of an export for the document; the name of a part is not recorded."""
    if choice[EXTENT] is Extent.SELECTED:
        name = last.name if last.ending == choice.ending else ""
    values = sorted(choice.values.items())
    options = tuple((key, msgspec.json.encode(value).decode()) for key, value in values)
    return Export(choice.ending, name, options)


def _usable(ending: object, values: Mapping[str, Any]) -> ExportChoice:
    known = [form.ending for form in FORMATS.offered]
    return choice_with(
        ending if isinstance(ending, str) and ending in known else ExportChoice().ending,
        {option: values[option.name] for option in offered_options() if option.name in values},
    )


def choice_with(ending: str, values: Mapping[Option[Any], Any]) -> ExportChoice:
    """Return a choice with the values of some options, or the defaults of those that cannot be used."""
    usable = {option: option.checked(value) for option, value in values.items()}
    others = {option.name: value for option, value in usable.items() if value != option.default}
    return ExportChoice(ending, others)


def offered_options() -> tuple[Option[Any], ...]:
    """Return the options of all formats that the window offers, in the order of their rows."""
    return all_options([(EXTENT, TRUE_SIZE), *(form.options for form in FORMATS.offered)])


def text_of(choice: ExportChoice) -> str:
    """Return a choice as JSON for other documents, without its extent."""
    values = {key: value for key, value in choice.values.items() if key != EXTENT.name}
    return msgspec.json.encode({"ending": choice.ending, **values}).decode()
