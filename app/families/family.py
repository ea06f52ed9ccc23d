"""The record of a curve family."""

from __future__ import annotations

import re
from collections.abc import Mapping
from inspect import isabstract
from types import ModuleType
from typing import Any, Self, final

import numpy.typing as npt

from curvecore import CurveError, FamilySetting, ParametricCurve
from curvecore.families.setting import SettingValue

from .chosen import NO_SETTINGS, ChosenSettings

_NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")


@final
class Family:
    """A curve family as the program knows it; compares and hashes by its name.

    Everything but the name is what the curve class says of itself. A family that is not there, because the
    package or file that brings it is not, has no class: its curves keep their points and cannot be drawn.

    Parameters
    ----------
    name
        The name that documents store.
    curve_class
        Makes its curves; None for a family that is not there.
    """

    __slots__ = ("_curve_class", "_name")

    def __init__(self, name: str, curve_class: type[ParametricCurve] | None) -> None:
        self._name, self._curve_class = name, curve_class

    @classmethod
    def of(cls, curve_class: type[ParametricCurve]) -> Self:
        """Return the family of a curve class."""
        return cls(str(curve_class.name), curve_class)

    @staticmethod
    def may_be_called(name: object) -> bool:
        """Whether a family, of this program or another one's, may have this name: a short identifier."""
        return isinstance(name, str) and _NAME.fullmatch(name) is not None

    @property
    def name(self) -> str:
        """The name that documents store: ``quintic_hermite``."""
        return self._name

    @property
    def is_missing(self) -> bool:
        """Whether nobody brought this family: a document names it all the same."""
        return self._curve_class is None

    @property
    def problem(self) -> str:
        """A sentence about the missing family; empty where it is there."""
        if not self.is_missing:
            return ""
        return (
            f"The family “{self._name}” is not installed: start with --families and the file that brings it, "
            "or choose another family."
        )

    @property
    def title(self) -> str:
        """The words within a sentence: quintic Hermite."""
        return self._name if self._curve_class is None else self._curve_class.title

    @property
    def label(self) -> str:
        """The words on a button: Quintic Hermite."""
        return self.title[:1].upper() + self.title[1:]

    @property
    def short(self) -> str:
        """The first word of the label, for a button where room is short."""
        return self.label.partition(" ")[0]

    @property
    def a_curve(self) -> str:
        """One of its curves, within a sentence: an averaging curve."""
        return f"{'an' if self.title[0] in 'aeiouAEIOU' else 'a'} {self.title} curve"

    @property
    def subject(self) -> str:
        """The same to begin a sentence: An averaging curve."""
        return f"A{self.a_curve[1:]}"

    @property
    def full_title(self) -> str:
        """The words where nothing else tells it from the others: cubic Hermite."""
        return (self._curve_class.full_title if self._curve_class is not None else "") or self.title

    @property
    def functions(self) -> str:
        """The name of its basis functions, to begin a sentence."""
        return ParametricCurve.functions if self._curve_class is None else self._curve_class.functions

    @property
    def point(self) -> str:
        """The word for its points within a sentence: those beside their curves are control points."""
        return "point" if self.interpolates else "control point"

    @property
    def tip(self) -> str:
        """A line about its curves."""
        return (self._curve_class.__doc__ or "").strip().partition("\n")[0].removesuffix(".")

    @property
    def icon(self) -> str:
        """The name of its icon; not every family has one."""
        return self._name.replace("_", "-")

    @property
    def action_name(self) -> str:
        """The object name of its action: familyQuinticHermite."""
        return "family" + "".join(word.capitalize() for word in self._name.split("_"))

    @property
    def derivatives(self) -> int:
        """The number of derivatives that a point carries beside its position."""
        return 0 if self._curve_class is None else self._curve_class.derivatives

    @property
    def can_close(self) -> bool:
        """Whether its curves can return to their first point."""
        return self._curve_class is not None and self._curve_class.can_close

    @property
    def why_open(self) -> str:
        """The reason for its curves not to return to their first point, as said of one of them."""
        if self.is_one_polynomial:
            return "is one polynomial, and one that is not constant cannot repeat itself smoothly"
        return "does not come back smoothly to its first point"

    @property
    def is_one_polynomial(self) -> bool:
        """Whether its curves are one polynomial from end to end."""
        return self._curve_class is not None and self._curve_class.is_one_polynomial

    @property
    def interpolates(self) -> bool:
        """Whether its curves run through their points."""
        return self._curve_class is None or self._curve_class.interpolates

    @property
    def is_local(self) -> bool:
        """Whether what a point carries does nothing beyond the two segments that meet there."""
        return self._curve_class is not None and self._curve_class.is_local

    @property
    def settings(self) -> tuple[FamilySetting, ...]:
        """What may be chosen about its functions beside the parameters."""
        return () if self._curve_class is None else self._curve_class.settings

    def values_of(self, chosen: Mapping[str, SettingValue]) -> dict[FamilySetting, SettingValue]:
        """Return the value of each setting: what was chosen, else the default."""
        return {setting: chosen.get(setting.name, setting.default) for setting in self.settings}

    def without_defaults(self, chosen: Mapping[str, SettingValue]) -> ChosenSettings:
        """Return what was chosen, without defaults; of a family that is not there all of it."""
        if self.is_missing:
            return ChosenSettings(chosen)
        defaults = {setting.name: setting.default for setting in self.settings}
        return ChosenSettings((name, value) for name, value in chosen.items() if value != defaults.get(name))

    def in_effect(self, chosen: ChosenSettings, *, closed: bool) -> ChosenSettings:
        """Return the settings of a curve, open or closed, of which these were chosen."""
        fixed = {each.name: each.when_closed for each in self.settings if each.when_closed is not None}
        return self.without_defaults({**chosen, **fixed}) if closed and fixed else chosen

    def make(
        self,
        jets: npt.ArrayLike,
        parameters: npt.ArrayLike,
        settings: Mapping[str, SettingValue] = NO_SETTINGS,
    ) -> ParametricCurve:
        """Return the curve with these data, shape (n, R, dim), at these parameters, shape (n,).

        Parameters
        ----------
        settings
            Values of its `settings`, by their names; the defaults where none is given.

        Raises
        ------
        CurveError
            If the data give no curve, a setting is none of the family's, or the family is not there.
        """
        if self._curve_class is None:
            raise CurveError(self.problem)
        return self._curve_class.from_jets(jets, parameters, **settings)

    def __eq__(self, other: object) -> bool:
        return self._name == other._name if isinstance(other, Family) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._name)

    def __str__(self) -> str:
        return self._name

    def __repr__(self) -> str:
        return f"<Family {self._name}>"

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return self


def families_of_module(module: ModuleType) -> list[type[ParametricCurve]]:
    """Return the curve classes that a module defines and gives a name: those of families."""
    own = (value for value in vars(module).values() if getattr(value, "__module__", "") == module.__name__)
    classes = (value for value in own if isinstance(value, type) and issubclass(value, ParametricCurve))
    # A property, as of chains, is no name of a family.
    return [each for each in classes if isinstance(vars(each).get("name"), str) and not isabstract(each)]
