"""Record of a curve family: its class, its words, and its settings.

A family is what its curve class says of itself; the record adds the words that menus, messages and tables
use, and whether the family is there at all.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from inspect import isabstract
from types import ModuleType
from typing import Any, NamedTuple, Self, final

import numpy.typing as npt

from curvecore import CurveError, FamilySetting, ParametricCurve
from curvecore.families.setting import SettingValue

# Settings


@final
class FamilySettingValues(Mapping[str, SettingValue]):
    """Values of family settings by their names: an immutable mapping, of which there is one empty one.

    Parameters
    ----------
    values
        Pairs of name and value, or a mapping; not checked against any family.
    """

    __slots__ = ("_pairs",)

    _pairs: tuple[tuple[str, SettingValue], ...]

    def __new__(
        cls, values: Mapping[str, SettingValue] | Iterable[tuple[str, SettingValue]] = ()
    ) -> FamilySettingValues:
        """Return the settings; of no values always the same object, which files then leave out."""
        pairs = tuple(dict(values).items())
        if not pairs and "NO_SETTINGS" in globals():
            return NO_SETTINGS
        settings = super().__new__(cls)
        settings._pairs = pairs
        return settings

    def __getitem__(self, name: str) -> SettingValue:
        return dict(self._pairs)[name]

    def __iter__(self) -> Iterator[str]:
        return (name for name, _ in self._pairs)

    def __len__(self) -> int:
        return len(self._pairs)

    def __eq__(self, other: object) -> bool:
        return dict(self) == dict(other) if isinstance(other, FamilySettingValues) else NotImplemented

    def __hash__(self) -> int:
        return hash(frozenset(self._pairs))

    def __repr__(self) -> str:
        return f"FamilySettingValues({dict(self._pairs)})"

    def __reduce__(self) -> tuple[Any, ...]:
        return FamilySettingValues, (self._pairs,)

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return self


NO_SETTINGS = FamilySettingValues()


class FamilySettings(NamedTuple):
    """The choices about the functions of a family.

    Attributes
    ----------
    all
        In the order of the form.
    are_known
        Whether the family is there, so that there are no others.
    """

    all: tuple[FamilySetting, ...]
    are_known: bool

    def named(self, name: str) -> FamilySetting | None:
        """Return the setting of a name; None where there is none."""
        return next((setting for setting in self.all if setting.name == name), None)

    def values(self, values: Mapping[str, SettingValue]) -> dict[FamilySetting, SettingValue]:
        """Return the value of each setting: the selected one, else the default."""
        return {setting: values.get(setting.name, setting.default) for setting in self.all}

    def without_defaults(self, values: Mapping[str, SettingValue]) -> FamilySettingValues:
        """Return values of these settings, without defaults; all of them if the family is missing.

        A family that was changed while its curves are open may no longer have a setting, or allow its value.
        """
        if not self.are_known:
            return FamilySettingValues(values)
        pairs = ((self.named(name), value) for name, value in values.items())
        return FamilySettingValues(
            (setting.name, value)
            for setting, value in pairs
            if setting is not None and setting.allows(value) and value != setting.default
        )

    def in_effect(self, values: FamilySettingValues, *, closed: bool) -> FamilySettingValues:
        """Return the values of a curve, open or closed: closing decides some of them."""
        fixed = {setting.name: setting.when_closed for setting in self.all if setting.when_closed is not None}
        return self.without_defaults({**values, **fixed}) if closed and fixed else values


# Words

_SHORT = 12
"""Letters up to which a label is short."""


class FamilyWords:
    """Words for a family, by its name and its curve class.

    Parameters
    ----------
    name
        The name that documents store: ``quintic_hermite``.
    """

    __slots__ = ("_curve_class", "_name", "curve_class")

    _curve_class: type[ParametricCurve] | None

    curve_class: type[ParametricCurve]
    """The class of its curves; of a missing family the base of all classes, with its defaults."""

    def __init__(self, name: str) -> None:
        self._name = name

    @property
    def name(self) -> str:
        """The name that documents store."""
        return self._name

    @property
    def is_missing(self) -> bool:
        """Whether no package or file brings this family, which a document names."""
        return self._curve_class is None

    @property
    def problem(self) -> str:
        """A sentence about the missing family; empty where it is there."""
        if not self.is_missing:
            return ""
        return (
            f"The family “{self._name}” is not available: start with --families and its file, "
            "or select another family."
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
        """A short label: the short title of the class, else the label, or its first word if it is long."""
        title, label = self.curve_class.short_title, self.label
        if title:
            return f"{title[:1].upper()}{title[1:]}"
        return label if len(label) <= _SHORT else label.partition(" ")[0]

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
        """The title that is clear by itself: cubic Hermite."""
        return self.curve_class.full_title or self.title

    @property
    def has_control_points(self) -> bool:
        """Whether its curves pass beside their points on purpose, not by mistake."""
        return not self.curve_class.interpolates

    @property
    def point(self) -> str:
        """The word for its points within a sentence: those beside their curves are control points."""
        return "control point" if self.has_control_points else "point"

    @property
    def tip(self) -> str:
        """A line about its curves."""
        return (self.curve_class.__doc__ or "").strip().partition("\n")[0].removesuffix(".")

    @property
    def action_name(self) -> str:
        """The object name of its action: familyQuinticHermite."""
        return "family" + "".join(word.capitalize() for word in self._name.split("_"))


# The record

_NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")


def may_be_name(name: object) -> bool:
    """Return whether a family or a setting may have this name."""
    return isinstance(name, str) and _NAME.fullmatch(name) is not None


class OverdueCallError(CurveError):
    """A curve is refused because functions of a family's file take too long for its number of points."""


@final
class Family(FamilyWords):
    """A curve family as the program knows it; compares and hashes by its name.

    Everything but the name is what the curve class says of itself. A family that is not there, because the
    package or file that brings it is not, has no class: its curves keep their points and cannot be drawn. The
    registry has one object for each name, which documents share: the class may come, be another one, and go.

    Parameters
    ----------
    name
        The name that documents store.
    curve_class
        Makes its curves; None for a family that is not there.
    misses_points
        Whether its curves were found to miss the points that the class says they run through.
    """

    __slots__ = ("_misses_points", "settings")

    settings: FamilySettings
    """The choices about its functions beside the parameters."""

    def __init__(
        self, name: str, curve_class: type[ParametricCurve] | None, *, misses_points: bool = False
    ) -> None:
        super().__init__(name)
        self._become(curve_class, misses_points=misses_points)

    def _become(self, curve_class: type[ParametricCurve] | None, *, misses_points: bool) -> None:
        self._curve_class, self._misses_points = curve_class, misses_points
        self.curve_class = curve_class or ParametricCurve
        self.settings = FamilySettings(self.curve_class.settings, are_known=curve_class is not None)

    @classmethod
    def of(cls, curve_class: type[ParametricCurve], *, misses_points: bool = False) -> Self:
        """Return the family of a curve class."""
        return cls(str(curve_class.name), curve_class, misses_points=misses_points)

    def become(self, other: Family) -> None:
        """Become another family of the same name, in all documents that name this one."""
        self._become(other._curve_class, misses_points=other._misses_points)

    def makes(self, curve: ParametricCurve) -> bool:
        """Return whether a curve, or the pieces of a chain, are of this family as it is now."""
        return type(curve.pieces[0]) is self._curve_class

    @property
    def is_built_in(self) -> bool:
        """Whether the family is one of the core, whose tests prove its functions."""
        core = ParametricCurve.__module__.partition(".")[0]
        return not self.is_missing and self.curve_class.__module__.startswith(f"{core}.")

    @property
    def derivatives(self) -> int:
        """The number of derivatives that a point carries beside its position."""
        return self.curve_class.derivatives

    @property
    def least_to_close(self) -> int:
        """Points that a closed curve has at least: two with velocities make a lens, alone no area."""
        return 2 if self.derivatives else 3

    @property
    def interpolates(self) -> bool:
        """Whether its curves run through their points: the class says so, and nothing else was found."""
        return self.curve_class.interpolates and not self._misses_points

    @property
    def takes_shapes(self) -> bool:
        """Whether curves of other families can be written as its own."""
        method, default = self.curve_class.same_shape_as, ParametricCurve.same_shape_as
        # Of methods of a class: the functions that they are.
        return getattr(method, "__func__", method) is not getattr(default, "__func__", default)

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
            Values of its `settings`, by their names; the defaults where none, or one that it does not allow,
            is given.

        Raises
        ------
        CurveError
            If the data give no curve, or the family is not there.
        """
        if self._curve_class is None:
            raise CurveError(self.problem)
        return self._curve_class.from_jets(jets, parameters, **self.settings.without_defaults(settings))

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
    defined = (
        value for value in vars(module).values() if getattr(value, "__module__", "") == module.__name__
    )
    classes = (value for value in defined if isinstance(value, type) and issubclass(value, ParametricCurve))
    # A property, as of chains, is no name of a family.
    return [
        curve_class
        for curve_class in classes
        if isinstance(vars(curve_class).get("name"), str) and not isabstract(curve_class)
    ]
