"""What the person chose for an export: remembered as JSON, and turned into what the writers take."""

from __future__ import annotations

import msgspec

from app.exchange.decor import Extras
from app.exchange.formats import SAMPLES, Options, Spacing
from app.exchange.sampled import TITLES
from app.exchange.svg import DARK, LIGHT

FORMATS = {
    ".png": "PNG picture",
    ".svg": "SVG drawing",
    ".pdf": "PDF document",
    ".dxf": "DXF splines",
    ".csv": "Table of samples (CSV)",
    ".tsv": "Table of samples (TSV)",
    ".points.csv": "Table of points (CSV)",
    ".py": "Python with NumPy",
    ".scipy.py": "Python with SciPy",
    ".tex": "LaTeX formula",
    ".tikz": "TikZ picture",
    ".pgfplots.tex": "PGFPlots axis",
    ".desmos.txt": "Desmos expressions",
    ".path.txt": "SVG path data",
    ".coefficients.json": "Polynomial coefficients",
}
"""What the window offers, by ending."""

DESCRIPTIONS = {
    ".png": "Pixels, for slides and pages.",
    ".svg": "Bézier curves, a path for each curve; cubic Hermite curves are exact.",
    ".pdf": "One page of outlines, sharp at every size.",
    ".dxf": "SPLINE entities of the true degree with their knots, a layer for each curve.",
    ".csv": "Numbers along each curve, with commas between them.",
    ".tsv": "Numbers along each curve, with tabs between them.",
    ".points.csv": "The points with their derivatives. Imported again, they give the same curves.",
    ".py": "A program that computes the curves; it needs NumPy alone.",
    ".scipy.py": "The curves as objects of scipy.interpolate.",
    ".tex": "The polynomials as a formula.",
    ".tikz": "Bézier curves for a TeX document.",
    ".pgfplots.tex": "A plot with axes for a TeX document.",
    ".desmos.txt": "Expressions to paste into Desmos, one a line.",
    ".path.txt": "The d attributes of SVG paths.",
    ".coefficients.json": "The coefficients of every polynomial piece, with the error that this form brings.",
}
"""What each is, in a sentence."""

PICTURES = (".png", ".svg", ".pdf")
SAMPLED = (".csv", ".tsv")
TO_SCALE = (".png", ".svg", ".pdf", ".tikz")
"""Those that can have true size."""

WITH_TOLERANCE = (".svg", ".pdf", ".dxf", ".tikz", ".pgfplots.tex", ".desmos.txt", ".path.txt")


class ExportChoice(msgspec.Struct, frozen=True):
    """The options of all formats; each takes what concerns it.

    Attributes
    ----------
    ending
        The format.
    width, scale
        Of a PNG: see `export`.
    dark, transparent
        The colours, and whether there is no paper.
    true_size
        Of pictures: whether a length of one is one of the unit, where there is one.
    points, handles, grid, basis
        What else to draw; the basis functions are those of the curve that is edited, as
        the panel shows them.
    tolerance
        None for the default.
    cubic
        Of DXF: no spline above degree 3.
    spacing, samples, columns
        Of tables of samples.
    """

    ending: str = ".png"
    width: int = 1600
    scale: float = 1.0
    dark: bool = False
    transparent: bool = False
    true_size: bool = True
    points: bool = False
    handles: bool = False
    grid: bool = False
    basis: bool = False
    tolerance: float | None = None
    cubic: bool = False
    spacing: Spacing = Spacing.T
    samples: int = SAMPLES
    columns: tuple[str, ...] = TITLES

    def options(self, active: int, unit: str = "", *, with_estimates: bool = False) -> Options:
        """Return the options of the format; `active` is the curve that is edited, `unit` what one is.

        `with_estimates` is whether the basis panel shows what each point does with its estimates.
        """
        is_picture = self.ending in PICTURES
        extras = Extras(self.handles, self.grid, active if self.basis else None, with_estimates)
        style = None
        if is_picture and (self.dark or not self.transparent):
            style = DARK if self.dark else LIGHT
        return Options(
            width=self.width if self.ending == ".png" else None,
            tolerance=self.tolerance,
            style=style,
            points=self.points,
            samples=self.samples,
            spacing=self.spacing,
            scale=self.scale,
            transparent=self.transparent,
            extras=extras if is_picture else None,
            columns=self.columns,
            cubic=self.cubic,
            unit=unit if self.true_size or self.ending not in TO_SCALE else "",
        )


def choice_from(text: str) -> ExportChoice:
    """Return the choice that was remembered as JSON; the default where it cannot be used."""
    try:
        choice = msgspec.json.decode(text or "{}", type=ExportChoice)
    except (msgspec.DecodeError, UnicodeError):
        return ExportChoice()
    usable = (
        choice.ending in FORMATS
        and 1 <= choice.width <= 16384
        and 0.1 <= choice.scale <= 10
        and (choice.tolerance is None or 0 < choice.tolerance < 1e12)
        and 2 <= choice.samples <= 1_000_000
        and set(choice.columns) <= set(TITLES)
        and choice.columns
    )
    return choice if usable else ExportChoice()


def text_of(choice: ExportChoice) -> str:
    """Return a choice as JSON."""
    return msgspec.json.encode(choice).decode()
