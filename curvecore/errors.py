"""The one exception that curvecore raises for input it cannot use."""

from __future__ import annotations

from collections.abc import Iterable


class CurveError(ValueError):
    """Exception for input that describes no curve.

    The message names the argument, the index (counted from 0, as in p_i and
    t_i) and the requirement, in words that can be shown to a person.

    Parameters
    ----------
    message : str
        What was asked for and what was found.
    indices : iterable of int, optional
        Positions of the offending points or parameters, empty when the
        input is wrong as a whole. A program that counts from 1 rewrites
        the message from these.

    Attributes
    ----------
    indices : tuple of int
        As given.

    See Also
    --------
    ParametricCurve : What is checked.

    Examples
    --------
    >>> from curvecore import CurveError, LagrangeCurve
    >>> try:
    ...     LagrangeCurve([[0, 0], [1, 2]], [1, 0])
    ... except CurveError as error:
    ...     print(error)
    ...     print(error.indices)
    parameters must be strictly increasing, but parameters[1] = 0.0 does not exceed parameters[0] = 1.0
    (0, 1)
    """

    def __init__(self, message: str, indices: Iterable[int] = ()) -> None:
        super().__init__(message)
        self.indices: tuple[int, ...] = tuple(int(index) for index in indices)
