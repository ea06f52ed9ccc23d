"""Settings of a family: choices about its basis functions beside the parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import isfinite
from operator import index
from typing import SupportsFloat

from curvecore.errors import CurveError

SettingValue = float | str
"""A number, whole or real, or the name of a choice."""


@dataclass(frozen=True)
class FamilySetting:
    """A number or a choice that the basis functions of a family depend on.

    A curve class lists its settings in `ParametricCurve.settings`; its constructor and `from_jets` take
    them as keyword arguments, and `ParametricCurve.chosen` has their values.

    Parameters
    ----------
    name : str
        A short identifier: of the keyword argument, and as files store it.
    title : str
        The name as people read it within a sentence.
    default : int, float or str
        The value where none is given. An int makes it a setting of whole numbers, a float one of real
        numbers.
    tip : str
        A sentence about it.
    limits : tuple of float, optional
        The least and the largest number; None for a setting with choices.
    choices : tuple of (str, str), optional
        The values and what people read for each, of a setting that is no number.
    when_closed : int, float or str, optional
        The value of closed curves, whatever was chosen: what makes them smooth where they close. None where
        closing asks for nothing.
    step : float, optional
        The step by which a slider or a key changes a number: 1 where none is given, of real numbers a
        hundredth of the distance between the limits.

    Raises
    ------
    CurveError
        If limits are not finite and ascending, those of whole numbers no whole numbers, or step is not above
        0.

    See Also
    --------
    ParametricCurve : Classes list their settings.

    Examples
    --------
    >>> from curvecore import FamilySetting
    >>> degree = FamilySetting("degree", "degree", 3, limits=(0, 9))
    >>> degree.allows(9), degree.allows(10), degree.requirement
    (True, False, 'a whole number from 0 to 9')
    >>> tension = FamilySetting("tension", "tension", 0.0, limits=(-1.0, 1.0), step=0.05)
    >>> tension.allows(0.3), tension.allows(1.5), tension.requirement
    (True, False, 'a number from -1 to 1')
    """

    name: str
    title: str
    default: SettingValue
    tip: str = ""
    limits: tuple[float, float] | None = None
    choices: tuple[tuple[str, str], ...] = ()
    when_closed: SettingValue | None = None
    step: float | None = None

    def __post_init__(self) -> None:
        if self.limits is not None:
            low, high = self.limits
            if not (isfinite(low) and isfinite(high) and low < high):
                raise CurveError(f"the limits of {self.name} must be finite and ascending, not {self.limits}")
            if self.is_whole and not (type(low) is int and type(high) is int):
                raise CurveError(f"the limits of {self.name} must be whole, as its default is: {self.limits}")
        if self.step is not None and not 0.0 < self.step < float("inf"):
            raise CurveError(f"the step of {self.name} must be above 0, not {self.step}")

    @property
    def label(self) -> str:
        """The title as it begins a line."""
        return self.title[:1].upper() + self.title[1:]

    @property
    def is_whole(self) -> bool:
        """Whether its numbers are whole, as the default is."""
        return type(self.default) is int

    def allows(self, value: object) -> bool:
        """Return whether the setting can have a value.

        Parameters
        ----------
        value : object
            Any.

        Returns
        -------
        bool
        """
        if self.limits is None:
            return isinstance(value, str) and value in dict(self.choices)
        is_number = type(value) is int or (not self.is_whole and isinstance(value, float))
        return is_number and self.limits[0] <= value <= self.limits[1]  # type: ignore[operator]

    @property
    def requirement(self) -> str:
        """The values that it can have, to follow "must be"."""
        if self.limits is None:
            return f"one of {', '.join(value for value, _ in self.choices)}"
        low, high = map(self.text_of, self.limits)
        return f"a {'whole ' if self.is_whole else ''}number from {low} to {high}"

    def text_of(self, value: SettingValue) -> str:
        """Return a value as people read it.

        Parameters
        ----------
        value : int, float or str
            One that is allowed.

        Returns
        -------
        str
            A real number with six digits at most.
        """
        if isinstance(value, str):
            return dict(self.choices).get(value, "")
        return str(value) if type(value) is int else f"{value:.6g}"

    def value_of(self, text: str) -> SettingValue:
        """Return the value that a text stands for, as on a command line.

        Parameters
        ----------
        text : str
            A number, or the name of a choice.

        Returns
        -------
        int, float or str
            The text itself where it is no number that the setting could have; `allows` refuses it.
        """
        try:
            return text if self.limits is None else int(text) if self.is_whole else float(text)
        except ValueError:
            return text


def chosen_values(
    settings: Iterable[FamilySetting], given: Mapping[str, object], title: str
) -> dict[str, SettingValue]:
    """Return the values of all settings of the family `title`, the defaults where none is given.

    Raises
    ------
    CurveError
        If a name is none of theirs, or a value is not allowed.
    """
    known = {setting.name: setting for setting in settings}
    for name in given:
        if name not in known:
            raise CurveError(f"{title} has no setting {name}")
    return {name: _checked(setting, given.get(name, setting.default)) for name, setting in known.items()}


def _checked(setting: FamilySetting, value: object) -> SettingValue:
    # NumPy's numbers become plain ones, and whole numbers real where the setting is.
    if setting.limits is not None and not isinstance(value, bool | str):
        if hasattr(value, "__index__"):
            value = index(value)
        if not setting.is_whole and isinstance(value, SupportsFloat):
            value = float(value)
    if not setting.allows(value):
        raise CurveError(f"{setting.name} must be {setting.requirement}, not {value!r}")
    assert isinstance(value, int | float | str)
    return value
