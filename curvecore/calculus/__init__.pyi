"""The names of the package and their modules: read by type checkers, and when one is first used."""

from curvecore.calculus.derivative import Antiderivative as Antiderivative
from curvecore.calculus.derivative import Derivative as Derivative
from curvecore.calculus.derivative import antiderivative_of as antiderivative_of
from curvecore.calculus.derivative import derivative_of as derivative_of
from curvecore.calculus.integrals import integral as integral
from curvecore.calculus.scipy_objects import curve_of_bpoly as curve_of_bpoly
from curvecore.calculus.scipy_objects import to_bpoly as to_bpoly
from curvecore.calculus.scipy_objects import to_ppoly as to_ppoly
from curvecore.calculus.solutions import solutions as solutions
