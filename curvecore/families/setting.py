"""Settings of a family: what a person may choose about its functions, beside the parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from operator import index

from curvecore.errors import CurveError

SettingValue = int | str
"""A whole number, or the name of a choice."""


@dataclass(frozen=True)
class FamilySetting:
    """A whole number or a choice that the basis functions of a family depend on.

    A curve class lists its settings in `ParametricCurve.settings`; its constructor and `from_jets` take
    them as keyword arguments.

    Parameters
    ----------
    name : str
        A short identifier: of the keyword argument, and as files store it.
    title : str
        The name as people read it within a sentence.
    default : int or str
        The value where none is given.
    tip : str
        A sentence about it.
    limits : tuple of int, optional
        The least and the largest whole number; None for a setting with choices.
    choices : tuple of (str, str), optional
        The values and what people read for each, of a setting that is no number.
    when_closed : int or str, optional
        The value of closed curves, whatever was chosen: what makes them smooth where they close. None where
        closing asks for nothing.

    See Also
    --------
    ParametricCurve : Classes list their settings.

    Examples
    --------
    >>> from curvecore import FamilySetting
    >>> tension = FamilySetting("tension", "tension", 1, limits=(0, 9))
    >>> tension.allows(9), tension.allows(10), tension.requirement
    (True, False, 'a whole number from 0 to 9')
    """

    name: str
    title: str
    default: SettingValue
    tip: str = ""
    limits: tuple[int, int] | None = None
    choices: tuple[tuple[str, str], ...] = ()
    when_closed: SettingValue | None = None

    @property
    def label(self) -> str:
        """The title as it begins a line."""
        return self.title[:1].upper() + self.title[1:]

    def allows(self, value: object) -> bool:
        """Tell whether the setting can have a value.

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
        return type(value) is int and self.limits[0] <= value <= self.limits[1]

    @property
    def requirement(self) -> str:
        """The values that it can have, to follow "must be"."""
        if self.limits is None:
            return f"one of {', '.join(value for value, _ in self.choices)}"
        return f"a whole number from {self.limits[0]} to {self.limits[1]}"

    def text_of(self, value: SettingValue) -> str:
        """Return a value as people read it.

        Parameters
        ----------
        value : int or str
            One that is allowed.

        Returns
        -------
        str
        """
        return dict(self.choices).get(value, "") if isinstance(value, str) else str(value)


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
    if setting.limits is not None and not isinstance(value, bool | str) and hasattr(value, "__index__"):
        value = index(value)  # NumPy's whole numbers, too
    if not setting.allows(value):
        raise CurveError(f"{setting.name} must be {setting.requirement}, not {value!r}")
    assert isinstance(value, int | str)
    return value
