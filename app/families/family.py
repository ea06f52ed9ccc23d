"""The record of a curve family."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from inspect import isabstract
from types import ModuleType
from typing import TYPE_CHECKING, Any, Self, final

import numpy.typing as npt

import curvecore
from curvecore import CurveError, FamilySetting, ParametricCurve
from curvecore.families.setting import SettingValue

from .chosen import NO_SETTINGS, ChosenSettings

if TYPE_CHECKING:
    from curvecore import Fit

_NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")


@final
class Family:
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

    __slots__ = ("_curve_class", "_misses_points", "_name")

    def __init__(
        self, name: str, curve_class: type[ParametricCurve] | None, *, misses_points: bool = False
    ) -> None:
        self._name, self._curve_class, self._misses_points = name, curve_class, misses_points

    @classmethod
    def of(cls, curve_class: type[ParametricCurve], *, misses_points: bool = False) -> Self:
        """Return the family of a curve class."""
        return cls(str(curve_class.name), curve_class, misses_points=misses_points)

    def become(self, other: Family) -> None:
        """Take over what another one of this name is; documents that name this one have that from now on."""
        self._curve_class, self._misses_points = other._curve_class, other._misses_points

    def makes(self, curve: ParametricCurve) -> bool:
        """Whether a curve is one of this family, as it is now; of a chain, its pieces."""
        return type(curve.pieces[0]) is self._curve_class

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
    def is_built_in(self) -> bool:
        """Whether it is one of the core's, whose tests prove its functions."""
        core = ParametricCurve.__module__.partition(".")[0]
        return self._curve_class is not None and self._curve_class.__module__.startswith(f"{core}.")

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
        """A word for a button where room is short: its own, or the first of the label."""
        own = "" if self._curve_class is None else self._curve_class.short_title
        return f"{own[:1].upper()}{own[1:]}" or self.label.partition(" ")[0]

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
        return "control point" if self.has_control_points else "point"

    @property
    def has_control_points(self) -> bool:
        """Whether its curves are meant to pass their points by; one that misses them by mistake has none."""
        return self._curve_class is not None and not self._curve_class.interpolates

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
        """Whether its curves run through their points: the class says so, and nothing else was found."""
        return self._curve_class is None or (self._curve_class.interpolates and not self._misses_points)

    @property
    def is_calm(self) -> bool:
        """Whether it is offered as a cure for a curve that swings out between its points."""
        return self._curve_class is not None and self._curve_class.is_calm

    @property
    def is_local(self) -> bool:
        """Whether what a point carries does nothing beyond the two segments that meet there."""
        return self._curve_class is not None and self._curve_class.is_local

    @property
    def settings(self) -> tuple[FamilySetting, ...]:
        """The choices about its functions beside the parameters."""
        return () if self._curve_class is None else self._curve_class.settings

    def values_of(self, chosen: Mapping[str, SettingValue]) -> dict[FamilySetting, SettingValue]:
        """Return the value of each setting: what was chosen, else the default."""
        return {setting: chosen.get(setting.name, setting.default) for setting in self.settings}

    def without_defaults(self, chosen: Mapping[str, SettingValue]) -> ChosenSettings:
        """Return what was chosen of its settings, without defaults; of a family that is not there all of it.

        One that was changed while its curves are open may no longer have, or allow, what was chosen.
        """
        if self.is_missing:
            return ChosenSettings(chosen)
        known = {setting.name: setting for setting in self.settings}
        kept = (
            (name, value) for name, value in chosen.items() if name in known and known[name].allows(value)
        )
        return ChosenSettings((name, value) for name, value in kept if value != known[name].default)

    @property
    def takes_shapes(self) -> bool:
        """Whether curves of other families can be written as its own."""
        if self._curve_class is None:
            return False
        own, base = self._curve_class.same_shape_as, ParametricCurve.same_shape_as
        # Of methods of a class: the functions that they are.
        return getattr(own, "__func__", own) is not getattr(base, "__func__", base)

    @property
    def follows(self) -> bool:
        """Whether its curves can come close to ones that do not consist of polynomials."""
        return self._curve_class is not None and self._curve_class.follows

    def check_shape(self, curve: ParametricCurve) -> None:
        """Raise CurveError where `curve` is none of this family, as far as that is told without work."""
        if self._curve_class is None:
            raise CurveError(self.problem)
        self._curve_class.check_shape(curve)

    def near(self, curve: ParametricCurve, tolerance: float) -> ParametricCurve:
        """Return a curve of this family within a tolerance of another one.

        Raises
        ------
        CurveError
            If it can be none, or no way to it is known.
        """
        if self._curve_class is None:
            raise CurveError(self.problem)
        return self._curve_class.near(curve, tolerance)

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
            Values of its `settings`, by their names; the defaults where none, or one that it does not allow,
            is given.

        Raises
        ------
        CurveError
            If the data give no curve, or the family is not there.
        """
        if self._curve_class is None:
            raise CurveError(self.problem)
        return self._curve_class.from_jets(jets, parameters, **self.without_defaults(settings))

    def fit(
        self,
        points: npt.ArrayLike,
        count: int | None = None,
        *,
        tolerance: float | None = None,
        parameters: npt.ArrayLike | None = None,
        settings: ChosenSettings = NO_SETTINGS,
        closed: bool = False,
        progress: Callable[[float], object] = lambda _share: None,
    ) -> Fit:
        """Return the curve of few points near many; see `curvecore.fit`.

        Raises
        ------
        CurveError
            If there is none, or the family is not there.
        """
        if self._curve_class is None:
            raise CurveError(self.problem)
        chosen = self.in_effect(settings, closed=closed)
        return curvecore.fit(
            points,
            self._curve_class,
            count,
            tolerance=tolerance,
            parameters=parameters,
            settings=chosen,
            closed=closed,
            progress=progress,
        )

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
