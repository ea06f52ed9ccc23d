"""The record of a curve family."""

from __future__ import annotations

import re
from collections.abc import Mapping
from inspect import isabstract
from types import ModuleType
from typing import Any, Self, final

import numpy.typing as npt

from curvecore import CurveError, ParametricCurve
from curvecore.families.setting import SettingValue

from .family_words import FamilyWords
from .settings import NO_SETTINGS, FamilySettings

_NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")


def may_be_name(name: object) -> bool:
    """Whether a family, of this program or another one's, or a setting may have this name."""
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
        self._take(curve_class, misses_points=misses_points)

    def _take(self, curve_class: type[ParametricCurve] | None, *, misses_points: bool) -> None:
        self._curve_class, self._misses_points = curve_class, misses_points
        self.curve_class = curve_class or ParametricCurve
        self.settings = FamilySettings(self.curve_class.settings, are_known=curve_class is not None)

    @classmethod
    def of(cls, curve_class: type[ParametricCurve], *, misses_points: bool = False) -> Self:
        """Return the family of a curve class."""
        return cls(str(curve_class.name), curve_class, misses_points=misses_points)

    def become(self, other: Family) -> None:
        """Take over what another one of this name is; documents that name this one have that from now on."""
        self._take(other._curve_class, misses_points=other._misses_points)

    def makes(self, curve: ParametricCurve) -> bool:
        """Whether a curve is one of this family, as it is now; of a chain, its pieces."""
        return type(curve.pieces[0]) is self._curve_class

    @property
    def is_built_in(self) -> bool:
        """Whether it is one of the core's, whose tests prove its functions."""
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
        own, base = self.curve_class.same_shape_as, ParametricCurve.same_shape_as
        # Of methods of a class: the functions that they are.
        return getattr(own, "__func__", own) is not getattr(base, "__func__", base)

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
    own = (value for value in vars(module).values() if getattr(value, "__module__", "") == module.__name__)
    classes = (value for value in own if isinstance(value, type) and issubclass(value, ParametricCurve))
    # A property, as of chains, is no name of a family.
    return [each for each in classes if isinstance(vars(each).get("name"), str) and not isabstract(each)]
