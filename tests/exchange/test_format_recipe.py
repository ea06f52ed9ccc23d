"""The recipe of the package of formats, run as it is printed."""

from __future__ import annotations

import re
import textwrap
from types import ModuleType

import pytest

from app.document.model import Document, make_curve
from app.exchange import formats
from app.exchange.files import export
from app.exchange.formats import FORMATS, Format
from app.exchange.options import Options

ARCH = [(0.0, 0.0), (2.0, 1.5), (4.0, -1.0)]


@pytest.fixture
def gcode():
    """The format of the recipe, registered."""
    recipe = re.search(r"(    # app/exchange/formats/gcode.py\n.*?)\n\n\S", formats.__doc__ or "", re.DOTALL)
    assert recipe is not None
    module = ModuleType("app.exchange.formats.gcode")
    module.__package__ = formats.__name__
    exec(compile(textwrap.dedent(recipe[1]), "gcode.py", "exec"), module.__dict__)
    record = next(value for value in vars(module).values() if isinstance(value, Format))
    with FORMATS.with_record(record):
        yield record


def test_the_format_of_the_recipe_writes_moves_within_the_tolerance(gcode, tmp_path):
    document = Document((make_curve(ARCH), make_curve(ARCH[::-1]), make_curve(ARCH[:1], name="dot")))
    shares = []
    options = Options(
        tolerance=1e-3, format_options={"feed": 250.0}, report=lambda share, _word: shares.append(share)
    )
    written = export(document, tmp_path / "arch.gcode", options)
    lines = (tmp_path / "arch.gcode").read_text().splitlines()
    assert lines[:3] == ["G21", "F250", "G0 X0.0 Y0.0"]
    assert lines[-1] == "G1 X0.0 Y0.0"
    assert sum(line.startswith("G0 ") for line in lines) == 2
    assert 0 < written.deviation <= 1e-3
    assert written.remarks == ("“dot”: A curve needs at least two points.",)
    assert shares[:-1] == sorted(shares[:-1])
    assert gcode in FORMATS.offered
