"""The settings that were chosen for a family, as a document holds them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Self, final

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
