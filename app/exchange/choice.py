"""A person's choice of format and options for an export: as JSON, and as options of the writers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import msgspec

from .drawing.styles import DARK, LIGHT
from .formats import FORMATS, Format
from .options import BASIS, DARK_PAPER, TRUE_SIZE, Option, Options, Value, all_options


@dataclass(frozen=True)
class ExportChoice:
    """A format and the values of all formats' options.

    Attributes
    ----------
    ending
        The format's.
    values
        Those that are not the default, by the options' names.
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
        return next(each for each in FORMATS.offered if each.ending == self.ending)

    def shown(self) -> tuple[Option[Any], ...]:
        """Return the options of the format that matter with these values."""
        options = self.format.options
        hidden = self.format.hidden({each.name: self[each] for each in options})
        return tuple(each for each in options if each not in hidden)

    def options(self, active: int, unit: str = "", *, with_estimates: bool = False) -> Options:
        """Return the options of the format; `active` is the curve that is edited, `unit` what one is.

        `with_estimates` is whether the basis panel shows what each point does with its estimates.
        """
        values = {each.name: self[each] for each in self.format.options}
        is_picture, dark = DARK_PAPER.name in values, values.pop(DARK_PAPER.name, False)
        has_basis, is_to_scale = values.pop(BASIS.name, False), values.pop(TRUE_SIZE.name, True)
        shared = {name: values.pop(name) for name in Options.__struct_fields__ if name in values}
        has_paper = is_picture and (dark or not shared.get("transparent"))
        return Options(
            **shared,
            style=(DARK if dark else LIGHT) if has_paper else None,
            basis=active if has_basis else None,
            with_estimates=with_estimates,
            unit=unit if is_to_scale else "",
            own=values,
        )


def choice_from(text: str) -> ExportChoice:
    """Return the choice that was remembered as JSON; the default of what cannot be used."""
    try:
        kept = msgspec.json.decode(text or "{}", type=dict[str, Any])
    except (msgspec.DecodeError, UnicodeError):
        return ExportChoice()
    ending = kept.get("ending")
    if ending not in [each.ending for each in FORMATS.offered]:
        ending = ExportChoice().ending
    return chosen(ending, {each: kept[each.name] for each in offered_options() if each.name in kept})


def chosen(ending: str, values: Mapping[Option[Any], Any]) -> ExportChoice:
    """Return a choice with the values of some options, or the defaults of those that cannot be used."""
    usable = {option: option.checked(value) for option, value in values.items()}
    return ExportChoice(ending, {each.name: kept for each, kept in usable.items() if kept != each.default})


def offered_options() -> tuple[Option[Any], ...]:
    """Return the options of all formats that the window offers, in the order of their rows."""
    return all_options(each.options for each in FORMATS.offered)


def text_of(choice: ExportChoice) -> str:
    """Return a choice as JSON."""
    return msgspec.json.encode({"ending": choice.ending, **choice.values}).decode()
