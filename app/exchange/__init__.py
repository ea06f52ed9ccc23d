"""Files in and out.

- ``drawing``: a document as cubic Bézier curves in a frame, the source of every picture.
- ``decor``: a grid, handles and basis functions to go with it.
- ``svg``: that drawing as SVG, exact or within a stated tolerance.
- ``image``: that SVG as PNG and PDF; needs Qt.
- ``parts``: the curves of a document and their pieces, the source of everything else that is written.
- ``code``, ``code_runtime``: Python with NumPy or SciPy.  ``latex``: formulas, TikZ, PGFPlots.
- ``formulas``: Desmos, SVG path data, coefficients.  ``sampled``, ``points_table``: tables.
- ``table``, ``table_source``: a table in memory, and the file it comes from.
- ``table_file``, ``table_lines``, ``table_layout``, ``table_columns``: tables of text in.
- ``table_array``, ``table_json``: arrays of NumPy and JSON in, as tables.
- ``table_curve``, ``thinning``: tables as curves, thinned out if asked.  ``table_import``: for the window.
- ``table_text``: blocks of numbers on the clipboard.
- ``svg_in``, ``svg_path``, ``arcs``, ``cubics_in``: SVG in, as Hermite curves.  ``svg_xml``: its tree,
  without DTD and entities.  ``svg_style``: its colours.
- ``dxf``: DXF out and in.
- ``animation``: motions as GIF, APNG and MP4.  ``motion_frames``: their frames; needs Qt.
- ``child``: a process with limits for the files of others.  ``reading``: which ending names which reader.
- ``formats``: the endings.  ``writing``, ``writers``: which ending names which writer.
- ``units``: how large a length of one is on paper.
- ``naming``: names made different from each other.
- ``choice``: what a person chose for an export.
- ``facts``: what ``curvebench info`` prints.

`export` chooses the writer by the name of the file.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from app.exchange.drawing import ExchangeError
    from app.exchange.formats import (
        ENDINGS,
        READABLE,
        SAMPLES,
        SUFFIXES,
        Exported,
        Options,
        Spacing,
    )
    from app.exchange.reading import import_file
    from app.exchange.svg import DARK, INK, LIGHT, Style, svg_of
    from app.exchange.writing import export, export_with

READER_PROCESS = "--reader-process"
"""First word of the command line of a bundle that shall read a drawing (see ``child``); not for people."""

_MODULES = {
    "drawing": ["ExchangeError"],
    "formats": ["ENDINGS", "READABLE", "SAMPLES", "SUFFIXES", "Exported", "Options", "Spacing"],
    "reading": ["import_file"],
    "svg": ["DARK", "INK", "LIGHT", "Style", "svg_of"],
    "writing": ["export", "export_with"],
}
_MODULE_OF = {name: module for module, names in _MODULES.items() for name in names}

__all__ = [
    "DARK",
    "ENDINGS",
    "INK",
    "LIGHT",
    "READABLE",
    "SAMPLES",
    "SUFFIXES",
    "ExchangeError",
    "Exported",
    "Options",
    "Spacing",
    "Style",
    "export",
    "export_with",
    "import_file",
    "svg_of",
]


def __getattr__(name: str) -> object:
    """Import readers and writers when they are first asked for: the editor starts without."""
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value: object = getattr(import_module(f"{__name__}.{_MODULE_OF[name]}"), name)
    globals()[name] = value
    return value
