"""The recipe of the package of formats, run as it is printed."""

from __future__ import annotations

import json
import re
import textwrap
from types import ModuleType

import pytest

from app.cli import main
from app.document.model import Document, make_curve
from app.exchange import formats
from app.exchange.files import export
from app.exchange.formats import FORMATS, ExportResult, Format
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


def test_a_file_without_curves_has_no_deviation(tmp_path, capsys):
    result = ExportResult("3 points\n", None)
    count = Format(
        endings=(".count",),
        title="Count",
        description="Number of points.",
        write=lambda _document, _options: result,
    )
    assert result.summary == ""
    source, target = tmp_path / "a.csv", tmp_path / "a.count"
    source.write_text("x,y\n0,0\n2,1\n4,0\n")
    with FORMATS.with_record(count):
        assert main(["convert", str(source), str(target)]) == 0
        assert capsys.readouterr().out.splitlines() == [str(target)]
        assert main(["convert", "--json", str(source), str(target)]) == 0
        assert json.loads(capsys.readouterr().out)["deviation"] is None
    assert target.read_text() == "3 points\n"
