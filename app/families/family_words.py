"""Words for a curve family: in sentences, on buttons and where room is short."""

from __future__ import annotations

from curvecore import ParametricCurve

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
        """A word where room is short: the class's own, else the label, of a long one its first word."""
        own, label = self.curve_class.short_title, self.label
        if own:
            return f"{own[:1].upper()}{own[1:]}"
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
        """The words where nothing else tells it from the others: cubic Hermite."""
        return self.curve_class.full_title or self.title

    @property
    def has_control_points(self) -> bool:
        """Whether its curves are meant to pass their points by; one that misses them by mistake has none."""
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
