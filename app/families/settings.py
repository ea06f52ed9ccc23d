"""The settings of a family, and those that were chosen of it, as a document holds them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple, Self, final

from curvecore import FamilySetting
from curvecore.families.setting import SettingValue


@final
class ChosenSettings(Mapping[str, SettingValue]):
    """Values by the names of settings; immutable, and there is one empty one.

    Parameters
    ----------
    values
        Pairs of name and value, or a mapping. Nobody asks here whether a family has them.
    """

    __slots__ = ("_pairs",)

    _pairs: tuple[tuple[str, SettingValue], ...]

    def __new__(
        cls, values: Mapping[str, SettingValue] | Iterable[tuple[str, SettingValue]] = ()
    ) -> ChosenSettings:
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
        return dict(self) == dict(other) if isinstance(other, ChosenSettings) else NotImplemented

    def __hash__(self) -> int:
        return hash(frozenset(self._pairs))

    def __repr__(self) -> str:
        return f"ChosenSettings({dict(self._pairs)})"

    def __reduce__(self) -> tuple[Any, ...]:
        return ChosenSettings, (self._pairs,)

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return self


NO_SETTINGS = ChosenSettings()


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
        return next((each for each in self.all if each.name == name), None)

    def values(self, chosen: Mapping[str, SettingValue]) -> dict[FamilySetting, SettingValue]:
        """Return the value of each setting: what was chosen, else the default."""
        return {setting: chosen.get(setting.name, setting.default) for setting in self.all}

    def without_defaults(self, chosen: Mapping[str, SettingValue]) -> ChosenSettings:
        """Return what was chosen of these, without defaults; of a family that is not there all of it.

        One that was changed while its curves are open may no longer have, or allow, what was chosen.
        """
        if not self.are_known:
            return ChosenSettings(chosen)
        found = ((self.named(name), value) for name, value in chosen.items())
        return ChosenSettings(
            (setting.name, value)
            for setting, value in found
            if setting is not None and setting.allows(value) and value != setting.default
        )

    def in_effect(self, chosen: ChosenSettings, *, closed: bool) -> ChosenSettings:
        """Return the settings of a curve, open or closed, of which these were chosen."""
        fixed = {each.name: each.when_closed for each in self.all if each.when_closed is not None}
        return self.without_defaults({**chosen, **fixed}) if closed and fixed else chosen
