"""The command line: what it prints, what it writes, and how it fails."""

import errno
import io
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace
from PIL import Image
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication, QDialog, QMainWindow

from app import __version__
from app.cli import main
from app.cli.windows import open_windows
from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.document.style import Style
from app.families import FAMILIES
from app.storage.files import load, save
from app.testing import Editor
from app.workbench.document_files import file_stem, title_of
from tests.rows import each_row
from tests.waiting import until

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "resources" / "examples"
LETTER = str(EXAMPLES / "letter_s.curve.json")


def run(*words, code="import sys; from app.cli import main; sys.exit(main())", **keywords):
    """The command line in a process of its own, with no display and no hint for Qt."""
    hidden = {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}
    environment = {key: value for key, value in os.environ.items() if key not in hidden}
    environment |= {"PYTHONPATH": str(ROOT), **keywords.pop("env", {})}
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", code, *words],
        capture_output=True,
        text=True,
        env=environment,
        check=False,
        **keywords,
    )


def refusal(capsys, *words):
    """The one line on stderr of a command that fails."""
    assert main(list(words)) == 1
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err.count("\n") == 1
    assert output.err.startswith("curvebench: ")
    assert "Traceback" not in output.err
    return output.err.removeprefix("curvebench: ").rstrip()


@pytest.mark.parametrize("output", ["out.curve.json", "out.svg", "out.png"])
def test_convert_and_render_show_their_progress_on_a_terminal(output, tmp_path, monkeypatch):
    """There was no word for the 4 s that a million rows take."""

    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    table = tmp_path / "rows.csv"
    table.write_text("x,y\n" + "".join(f"{k},{k % 7}\n" for k in range(12_000)))
    monkeypatch.setattr("app.cli.output.PATIENCE", -1.0)
    monkeypatch.setattr(sys, "stderr", terminal := Terminal())
    word, source = ("convert", str(table)) if output.endswith("json") else ("render", LETTER)
    target = str(tmp_path / output)
    assert main([word, source, *(["-o", target] if word == "render" else [target])]) == 0
    told = [each for each in terminal.getvalue().split("\r") if "%" in each]
    assert len(told) >= 3
    assert all(each.endswith("%\033[K") for each in told)
    # The line is gone before anything else is said.
    assert terminal.getvalue().rpartition("%\033[K")[2].startswith("\r\033[K")


def test_info_prints_the_facts(capsys):
    assert main(["info", LETTER]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "Letter S"
    rows = {line[2:18].rstrip(): line[19:] for line in lines[1:]}
    assert rows["family"] == "cubic Hermite"
    assert rows["degree"] == "3 on every segment"
    assert rows["points"] == "9"
    assert rows["parametrization"] == "chord length"
    assert rows["domain"] == "0 to 1"
    assert rows["length"].startswith("about 23.0")
    assert rows["box"].startswith("about x 0.35 to 5.99")
    assert rows["Λ (Lebesgue)"] == "1.7 (with fixed estimated derivatives: 1)"
    assert "warning" not in rows


def test_info_restricts_the_error_growth_of_a_nonlinear_rule_to_the_given_points(tmp_path, capsys):
    """It said 1.69, a mean of x and y. Beside a corner between straight runs there is no bound."""
    worse = [(1, 6), (0, 0), (3, 0), (1, 3), (2, 6), (4, 6), (2, 6)]
    corner = [(0, 0), (1, 1), (2, 2), (3, 1), (4, 0)]
    path = tmp_path / "two.curve.json"
    curves = [
        {"name": "a", "family": "hermite", "parametrization": {"kind": kind}, "velocity_rule": "akima",
         "points": [{"x": x, "y": y} for x, y in points]}
        for kind, points in (("chord_length", worse), ("uniform", corner))
    ]  # fmt: skip
    path.write_text(json.dumps({"format": "curvebench", "version": 2, "curves": curves}))
    assert main(["info", str(path)]) == 0
    rows = [line[19:] for line in capsys.readouterr().out.splitlines() if "Λ" in line]
    assert rows == [
        "9.16 at these points (with fixed estimated derivatives: 1)",
        "too large to represent at these points",
    ]
    assert main(["info", str(path), "--json"]) == 0
    first, second = json.loads(capsys.readouterr().out)["curves"]
    assert first["lebesgue_constant"]["points"] == pytest.approx(9.162, abs=1e-3)
    assert second["lebesgue_constant"] == {"data": 1.0, "points": None}
    assert [each["lebesgue_constant_holds"] for each in (first, second)] == ["at these points"] * 2
    assert "without bound along the curve (Lebesgue constant at these points)" in second["warnings"][0]


def test_info_as_json(capsys):
    assert main(["info", LETTER, "--json"]) == 0
    content = json.loads(capsys.readouterr().out)
    assert content["file"] == LETTER
    (curve,) = content["curves"]
    assert curve["name"] == "Letter S"
    assert curve["family"] == "hermite"
    assert curve["degree"] == 3
    assert curve["parametrization"] == {"kind": "chord_length", "alpha": 0.5, "start": 0.0, "end": 1.0}
    assert curve["domain"] == [0.0, 1.0]
    # It was said nowhere, and 1 in the window; the velocities of the letter are estimated.
    assert curve["lebesgue_constant"] == {"data": 1.0, "points": pytest.approx(1.70, abs=0.005)}
    assert curve["lebesgue_constant_holds"] is None
    assert curve["length"]["about"] == pytest.approx(23.0, abs=0.1)
    assert curve["box"]["left"] == pytest.approx(0.35)
    assert curve["warnings"] == []


@pytest.mark.parametrize(
    ("style", "words"),
    [
        (Style(), "stroke in ink, the default width"),
        (Style("#d55e00", 2.0, fill="#ffcc88"), "stroke #d55e00, 2 mm; fill #ffcc88"),
        (Style("none", fill="#ffcc88", fill_opacity=0.5), "fill #ffcc88, 50% opaque"),
        (Style("none"), "none"),
        (
            Style("#000000", 0.5, dash=(2.0, 1.0), stroke_opacity=0.25),
            "stroke #000000, 25% opaque, 0.5 mm, dashes 2 1",
        ),
    ],
)
def test_info_prints_the_style_and_the_unit(style, words, tmp_path, capsys):
    path = tmp_path / "a.curve.json"
    curve = replace(make_curve(((0.0, 0.0), (1.0, 1.0))), style=style)
    save(path, Document((curve,), unit="mm"))
    assert main(["info", str(path)]) == 0
    lines = {line[:18].strip(): line[19:] for line in capsys.readouterr().out.splitlines()}
    assert (lines["style"], lines["unit"]) == (words, "mm")
    assert main(["info", "--json", str(path)]) == 0
    content = json.loads(capsys.readouterr().out)
    assert content["unit"] == "mm"
    assert content["curves"][0]["style"]["stroke"] == style.stroke


def test_render_draws_only_the_named_curves(tmp_path, capsys):
    path, picture = tmp_path / "a.curve.json", tmp_path / "a.svg"
    curves = [
        make_curve(((x, 0.0), (x + 1.0, 2.0)), name=name) for x, name in ((0.0, "leaf 1"), (9.0, "stem"))
    ]
    save(path, Document(tuple(curves), unit="mm"))
    assert main(["render", str(path), "-o", str(picture), "--only", "leaf*"]) == 0
    text = picture.read_text(encoding="utf-8")
    assert text.count("<path ") == 1
    assert float(text.partition('width="')[2].partition("mm")[0]) < 2
    assert main(["render", str(path), "-o", str(picture)]) == 0
    assert picture.read_text(encoding="utf-8").count("<path ") == 2
    assert main(["render", str(path), "-o", str(picture), "--only", "root"]) != 0
    assert "No curve or group is named “root”; the file contains leaf 1, stem." in capsys.readouterr().err


def test_info_prints_shapes_and_groups(tmp_path, capsys):
    path = tmp_path / "r.curve.json"
    curves = [make_curve([(0, k), (1, k)], name=name) for k, name in enumerate(("Outer", "Counter", "Leaf"))]
    inside = [replace(curve, shape="R", groups=("Logo", "Letters")) for curve in curves[:2]]
    save(path, Document((*inside, curves[2])))
    assert main(["info", str(path)]) == 0
    outer, _, leaf = capsys.readouterr().out.split("\n\n")
    assert outer.splitlines()[:3] == ["Outer", "  shape            R", "  group            Logo > Letters"]
    assert not {"shape", "group"} & {line.split()[0] for line in leaf.splitlines()}
    assert main(["info", "--json", str(path)]) == 0
    told = [(each["shape"], each["groups"]) for each in json.loads(capsys.readouterr().out)["curves"]]
    assert told == [("R", ["Logo", "Letters"])] * 2 + [(None, [])]


@pytest.mark.parametrize(("count", "degree", "kind"), [(5, 4, None), (6, None, "rational, blended degree 3")])
def test_info_names_degree_and_kind_of_a_rational_curve(tmp_path, capsys, count, degree, kind):
    path = tmp_path / "rational.curve.json"
    points = [(k, k % 2) for k in range(count)]
    save(path, Document((make_curve(points, family=FAMILIES.named("floater_hormann")),)))
    assert main(["info", str(path)]) == 0
    text = capsys.readouterr().out
    assert ("  degree           4\n" in text) == (degree is not None)
    assert (f"  kind             {kind}\n" in text) == (kind is not None)
    assert main(["info", "--json", str(path)]) == 0
    (curve,) = json.loads(capsys.readouterr().out)["curves"]
    assert (curve["degree"], curve["kind"]) == (degree, kind)


@pytest.mark.parametrize(("own", "digits"), [("natural_spline", None), ("gaussian", [9, 8, 6])])
def test_info_states_which_derivatives_are_differences(own, digits, tmp_path, capsys):
    path, file = tmp_path / "own.curve.json", Path(__file__).parent / f"data/families/{own}.py"
    family = FAMILIES.named(f"tests_{own}")
    save(path, Document((make_curve([(0, 0), (1, 2), (2, 1), (3, 0)], family=family),)))
    assert main(["info", str(path), "--families", str(file)]) == 0
    row = "  derivatives      differences, c′, c″, c‴ to some 9, 8, 6 digits\n"
    assert (row in capsys.readouterr().out) == (digits is not None)
    assert main(["info", "--json", str(path), "--families", str(file)]) == 0
    assert json.loads(capsys.readouterr().out)["curves"][0]["difference_digits"] == digits


def test_info_of_a_sketch_just_begun(tmp_path, capsys):
    path = tmp_path / "begun.curve.json"
    save(path, Document((make_curve([(1, 2)], name="two\nlines \x1b[31m"), make_curve([(0, 0), (1, 1)]))))
    assert main(["info", str(path)]) == 0
    text = capsys.readouterr().out
    assert text.startswith("two lines  [31m\n")
    assert "warning          A curve needs at least two points." in text
    assert main(["info", "--json", str(path)]) == 0
    (begun, _) = json.loads(capsys.readouterr().out)["curves"]
    assert begun["length"] is begun["lebesgue_constant"] is None
    assert set(begun["missing"].values()) == {"A curve needs at least two points."}


MANUAL = Parametrization(ParametrizationKind.MANUAL)


def test_info_of_many_points_has_the_length_and_the_constant_or_the_reason(tmp_path, capsys):
    """Both were left out above 500 points, without a word."""
    angle = 3.0 - 3.0 * np.cos(np.linspace(0.0, np.pi, 600))
    rule = Parametrization(ParametrizationKind.CHEBYSHEV)
    calm = replace(make_curve(np.column_stack([np.cos(angle), np.sin(angle)])), parametrization=rule)
    wild = replace(make_curve([(1.0, (-1.0) ** i) for i in range(41)]), parametrization=MANUAL)
    at = [i * 1e-12 for i in range(40)] + [1e12]
    wild = replace(wild, points=tuple(replace(p, t=t) for p, t in zip(wild.points, at, strict=True)))
    save(path := tmp_path / "many.curve.json", Document((calm, wild)))
    save(path_of_wild := tmp_path / "wild.curve.json", Document((wild,)))
    assert main(["info", "--json", str(path)]) == 0
    calm, wild = json.loads(capsys.readouterr().out)["curves"]
    # An arc of radius 1; of n Chebyshev points of the second kind Λ is (2/π)(ln(n-1) + γ + ln(8/π)) nearly.
    assert abs(calm["length"]["about"] - 6.0) <= calm["length"]["error"] + 1e-13
    bound = 2.0 / np.pi * (np.log(599) + np.euler_gamma + np.log(8.0 / np.pi))
    assert calm["lebesgue_constant"]["points"] == pytest.approx(bound, abs=1e-3)
    assert calm["missing"] == {}
    # The products of 39 factors (t - t_j) / (t_i - t_j) reach some (10²⁴)³⁹.
    assert wild["length"] is None
    assert wild["lebesgue_constant"] == {"data": None, "points": None}
    assert wild["missing"] == dict.fromkeys(("length", "lebesgue_constant"), "too large to represent")
    assert main(["info", str(path_of_wild)]) == 0
    rows = capsys.readouterr().out.splitlines()
    said = [row.split("  ")[-1].strip() for row in rows if "length   " in row or "Λ (" in row]
    assert said == ["too large to represent"] * 2


@pytest.mark.parametrize(
    ("start", "end", "text"),
    [
        (1e6, 1e6 + 1, "1000000 to 1000001"),
        (1e6, 1e6 + 1 / 3, "1000000 to 1000000.333"),
        (-1.0, 1e-9, "-1 to 1e-09"),
        (0.1, 0.1 + 2.0**-56, "0.10000000000000001 to 0.10000000000000002"),
        (1e9 + 0.25, 1e9 + 0.5, "1000000000.25 to 1000000000.5"),
    ],
)
def test_info_prints_distinguishable_ends_of_the_domain(tmp_path, capsys, start, end, text):
    """It said "domain 1e+06 to 1e+06"."""
    rule = Parametrization(ParametrizationKind.UNIFORM, start=start, end=end)
    curve = replace(make_curve([(1e6, 0.0), (1e6 + 1.0, 1.0)]), parametrization=rule)
    save(path := tmp_path / "far.curve.json", Document((curve,)))
    assert main(["info", str(path)]) == 0
    said = capsys.readouterr().out
    assert f"domain           {text}\n" in said
    assert "x 1000000 to 1000001, y 0 to 1" in said


@pytest.mark.usefixtures("drawings_read_here")
def test_info_of_an_svg_prints_coordinates_above_the_lower_edge(tmp_path, capsys):
    path = tmp_path / "in.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="50mm" viewBox="0 0 40 50">'
        '<path id="r1" d="M2 12H10V20H2z" fill="#00ff00"/></svg>',
        encoding="utf-8",
    )
    assert main(["info", str(path)]) == 0
    assert "  box              about x 2 to 10, y 30 to 38\n" in capsys.readouterr().out
    assert main(["info", "--json", str(path)]) == 0
    content = json.loads(capsys.readouterr().out)
    assert content["curves"][0]["box"] == {"left": 2.0, "bottom": 30.0, "right": 10.0, "top": 38.0}


@pytest.mark.parametrize("suffix", ["svg", "png", "pdf"])
@pytest.mark.usefixtures("qapp")
def test_render_writes_every_format(suffix, tmp_path, capsys):
    out = tmp_path / f"a.{suffix}"
    words = ["render", LETTER, "-o", str(out), "--width", "90", "--tolerance", "0.01", "--points"]
    assert main([*words, "--theme", "dark"]) == 0
    assert capsys.readouterr() == ("", "")
    start = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF"}[suffix]
    assert out.read_bytes().startswith(start)


def test_render_uses_its_options(tmp_path):
    out = tmp_path / "a.svg"
    main(["render", LETTER, "-o", str(out), "--width", "90", "--tolerance", "0.25", "--theme", "dark"])
    text = out.read_text(encoding="utf-8")
    assert 'width="90"' in text
    assert "(tolerance 0.25)" in text
    assert "#15181c" in text
    assert "circle" not in text


def test_bad_files_are_refused_in_one_line(tmp_path, capsys):
    bad = tmp_path / "bad.curve.json"
    for command in (["info"], ["render", "-o", str(tmp_path / "a.svg")], []):
        bad.write_text('{"format": "curvebench",\n "version": 4, "curves": 3}', encoding="utf-8")
        line = refusal(capsys, *command, str(bad))
        assert line == f"“{bad}” cannot be read: curves must be a list, not a whole number"
        line = refusal(capsys, *command, str(tmp_path / "gone"))
        assert line.startswith("There is no file “")
        assert refusal(capsys, *command, str(tmp_path)).endswith("is a folder. Choose a file.")
    assert list(tmp_path.iterdir()) == [bad]


@pytest.mark.usefixtures("drawings_read_here")
def test_other_formats_are_read_as_by_convert(tmp_path, capsys):
    """It was said of a table that it is not JSON, and of an SVG that another command reads it."""
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="40mm" viewBox="0 0 40 40">'
        '<path id="r1" d="M2 2L10 2L10 10Z" fill="#00ff00"/><image href="x.png" width="3" height="3"/></svg>'
    )
    files = (
        ("a.csv", "0,0\n1,1\n", []),
        ("a.json", "[[0, 0], [1, 1]]", ["--width", "90"]),
        ("in.svg", svg, []),
    )
    for name, text, size in files:
        path, drawn, converted = tmp_path / name, tmp_path / "drawn.png", tmp_path / "converted.png"
        path.write_text(text, encoding="utf-8")
        assert main(["render", str(path), "-o", str(drawn), *size]) == 0
        said = capsys.readouterr().err
        assert ("picture" in said) is (name == "in.svg")
        assert main(["convert", str(path), str(converted), *size]) == 0
        assert drawn.read_bytes() == converted.read_bytes()
        capsys.readouterr()
        assert main(["info", str(path), "--json"]) == 0
        assert len(json.loads(capsys.readouterr().out)["curves"]) == 1
    film = ["render", str(tmp_path / "a.csv"), "-o", str(tmp_path / "a.gif")]
    assert main([*film, "--seconds", "0.2", "--width", "90"]) == 0
    capsys.readouterr()
    assert refusal(capsys, "info", str(tmp_path / "gone.csv")).startswith("There is no file “")
    broken = tmp_path / "a.json"
    broken.write_text('{"format": "curvebench", "version": 4, "curves": 3}', encoding="utf-8")
    assert refusal(capsys, "info", str(broken)).endswith("curves must be a list, not a whole number")


def test_a_folder_is_refused_as_a_folder(tmp_path, capsys):
    """`convert . x.json` said that the name “” has no known file extension."""
    table = tmp_path / "a.csv"
    table.write_text("0,0\n1,1\n", encoding="utf-8")
    for words in (
        ["convert", str(tmp_path), str(tmp_path / "x.json")],
        ["convert", str(table), str(tmp_path)],
        ["render", str(table), "-o", str(tmp_path)],
    ):
        assert refusal(capsys, *words) == f"“{tmp_path}” is a folder. Choose a file."


@pytest.mark.usefixtures("drawings_read_here")
def test_convert_reports_losses_as_json(tmp_path, capsys):
    path = tmp_path / "a.svg"
    path.write_text('<svg><flowRoot id="t">Hi</flowRoot><path d="M0 0L1 1"/></svg>', encoding="utf-8")
    assert main(["convert", "--json", str(path), str(tmp_path / "a.curve.json")]) == 0
    output = capsys.readouterr()
    assert output.err == ""
    assert json.loads(output.out) == {
        "output": str(tmp_path / "a.curve.json"),
        "deviation": 0.0,
        "deviation_is_bound": True,
        "remarks": ["1 text left out: t."],
    }


@pytest.mark.usefixtures("drawings_read_here")
def test_convert_reads_the_curves_of_a_drawing_and_reports_the_rest(tmp_path, capsys):
    path, out = tmp_path / "a.svg", tmp_path / "a.curve.json"
    page = '<svg xmlns="http://www.w3.org/2000/svg" width="200" height="200">{}</svg>'
    path.write_text(page.format('<path d="M5 5L20 5 20 20L35"/><rect width="9" height="9"/>'), "utf-8")
    assert main(["convert", str(path), str(out)]) == 0
    said = "curvebench: 1 path imported only up to an error in the data: Path 2 at the end.\n"
    assert capsys.readouterr().err == said
    assert [len(curve.points) for curve in load(out).curves] == [3, 4]
    # A page without a curve is an empty document, and no picture.
    path.write_text(page.format('<path id="b" d="L1 1"/>'), "utf-8")
    assert main(["convert", str(path), str(out)]) == 0
    assert "b at character 1" in capsys.readouterr().err
    assert ([curve.points for curve in load(out).curves], load(out).unit) == ([()], "px")
    words = refusal(capsys, "convert", str(path), str(tmp_path / "a.png"))
    assert "The file contains no curves. 1 path imported only up to an error in the data: b at" in words


@pytest.mark.usefixtures("drawings_read_here")
def test_convert_keeps_unit_and_styles_of_a_drawing(tmp_path, capsys):
    path = tmp_path / "a.svg"
    path.write_text(
        '<svg width="70mm" height="50mm" viewBox="0 0 140 100"><g id="G"><path id="p" d="M0 0H90V90Z" '
        'fill="#ff0000" stroke="#0000ff" stroke-width="3"/></g></svg>',
        encoding="utf-8",
    )
    document, back = tmp_path / "a.curve.json", tmp_path / "b.svg"
    assert main(["convert", str(path), str(document)]) == 0
    assert main(["render", str(document), "-o", str(back)]) == 0
    text = back.read_text(encoding="utf-8")
    assert re.search(r'width="4[78][.\d]*mm"', text)
    assert '<g id="G">' in text
    assert 'fill="#ff0000" stroke="#0000ff" stroke-width="1.5"' in text
    assert "rect" not in text
    assert capsys.readouterr().err == ""


@pytest.mark.usefixtures("drawings_read_here")
def test_convert_accepts_groups_of_a_drawing_by_name(tmp_path, capsys):
    """All 167 curves of a plot came in, glyphs and ticks and all, with no choice."""
    line = '<g id="line2d_{0}"><path d="M0 {0}H9"/></g>'
    drawing, out = tmp_path / "a.svg", tmp_path / "a.curve.json"
    groups = "".join(map(line.format, range(21)))
    drawing.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><g id="axes">{groups}</g></svg>',
        encoding="utf-8",
    )
    assert main(["convert", str(drawing), str(out)]) == 0
    assert "The file contains 21 curves; --only NAME selects those of a group: axes (21), line2d_0, " in (
        capsys.readouterr().err
    )
    only = ["--only", "line2d_3", "--only", "line2d_1?"]
    assert main(["convert", str(drawing), str(out), *only]) == 0
    told = capsys.readouterr().err
    assert "These are" not in told
    assert [curve.points[0].y for curve in load(out).curves] == [6, *range(-1, -11, -1)]
    words = refusal(capsys, "convert", str(drawing), str(out), "--only", "nothing")
    assert words.startswith("No curve or group is named “nothing”; the file contains axes (21), line2d_0, ")


@pytest.mark.parametrize(
    ("points", "box"),
    [
        ([(-5e-20, 0.0), (1.0, 1.0)], "about x 0 to 1, y 0 to 1"),  # was: x -5e-20 to 1
        ([(-5e-20, 1e-9), (2e-20, 1.0)], "about x -5e-20 to 2e-20, y 1e-09 to 1"),
    ],
)
def test_the_box_of_info_holds_no_rounding_and_all_numbers(tmp_path, capsys, points, box):
    path = tmp_path / "a.curve.json"
    save(path, Document((make_curve(points),)))
    assert main(["info", str(path)]) == 0
    (line,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("  box")]
    assert line.removeprefix("  box").strip() == box


def test_impossible_renders_are_refused_in_one_line(tmp_path, capsys):
    empty = tmp_path / "empty.curve.json"
    save(empty, Document((make_curve(()),)))
    assert "known file extension" in refusal(capsys, "render", LETTER, "-o", str(tmp_path / "a.bmp"))
    assert "nothing to draw" in refusal(capsys, "render", str(empty), "-o", str(tmp_path / "a.svg"))
    assert "does not exist" in refusal(capsys, "render", LETTER, "-o", str(tmp_path / "no" / "a.svg"))


ENDS = [
    *[".curve.json", ".coefficients.json", ".py", ".scipy.py", ".tex", ".tikz", ".pgfplots.tex"],
    *[".desmos.txt", ".path.txt", ".csv", ".tsv", ".svg", ".dxf", ".png", ".pdf"],
]


@pytest.mark.parametrize("ending", ENDS)
def test_convert_writes_every_format_and_reports_the_deviation(ending, tmp_path, capsys):
    out = tmp_path / f"a{ending}"
    assert main(["convert", LETTER, str(out), "--tolerance", "0.01", "--samples", "9"]) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert said.out.startswith(f"{out}: largest deviation from the true curves ")
    assert float(said.out.split()[-1]) < 0.5
    assert out.stat().st_size > 100


def test_convert_accepts_settings_of_the_family_and_info_prints_the_settings(tmp_path, capsys):
    table, curve = tmp_path / "bell.csv", tmp_path / "bell.curve.json"
    table.write_text("x,y\n" + "\n".join(f"{x},{1 / (1 + x * x)}" for x in range(-5, 6)))
    family = ["--family", "floater_hormann"]
    assert main(["convert", str(table), str(curve), *family, "--setting", "degree=5"]) == 0
    capsys.readouterr()
    assert main(["info", "--json", str(curve)]) == 0
    assert json.loads(capsys.readouterr().out)["curves"][0]["settings"] == {"degree": 5}
    assert main(["info", str(curve)]) == 0
    assert re.search(r"^  blended degree +5$", capsys.readouterr().out, re.MULTILINE)
    assert main(["convert", str(table), str(curve), *family, "--setting", "degree=50"]) == 1
    assert "--setting must be of floater_hormann with degree= and a whole number" in capsys.readouterr().err
    assert main(["convert", str(table), str(curve), "--setting", "degree=5"]) == 1
    assert "hermite alone, which has no settings" in capsys.readouterr().err


def test_convert_and_info_accept_real_settings_of_a_family_file(tmp_path, capsys):
    table, curve = tmp_path / "bell.csv", tmp_path / "bell.curve.json"
    table.write_text("x,y\n" + "\n".join(f"{x},{1 / (1 + x * x)}" for x in range(-5, 6)))
    file = ["--families", str(Path(__file__).parent / "data" / "families" / "cardinal_spline.py")]
    convert = ["convert", *file, str(table), str(curve), "--family", "cardinal_spline", "--setting"]
    assert main([*convert, "tension=-0.35"]) == 0
    capsys.readouterr()
    assert main(["info", *file, "--json", str(curve)]) == 0
    assert json.loads(capsys.readouterr().out)["curves"][0]["settings"] == {"tension": -0.35}
    assert main(["info", *file, str(curve)]) == 0
    assert re.search(r"^  tension +-0\.35$", capsys.readouterr().out, re.MULTILINE)
    assert main([*convert, "tension=1.5"]) == 1
    assert "cardinal_spline with tension= and a number from -1 to 1" in capsys.readouterr().err


@each_row(
    ("typed", "name"),
    [
        *((family.name, family.name) for family in FAMILIES),
        *((family.label, family.name) for family in FAMILIES),
        ("BÉZIER", "bezier"),
        ("quintic-hermite", "quintic_hermite"),
        ("Cubic Hermite", "hermite"),
        ("b-spline", "b_spline"),
    ],
)
def test_a_family_is_accepted_by_its_displayed_title(typed, name, tmp_path, capsys):
    """`--family Bézier` was refused, and with it a list that the title was not in."""
    table, curve = tmp_path / "line.csv", tmp_path / "line.curve.json"
    table.write_text("x,y\n0,0\n1,2\n2,1\n3,3\n")
    assert main(["convert", str(table), str(curve), "--family", typed]) == 0
    assert load(curve).curves[0].family.name == name


def test_an_unknown_family_is_refused_with_the_list_of_families(tmp_path, capsys):
    with pytest.raises(SystemExit):
        main(["convert", LETTER, str(tmp_path / "a.curve.json"), "--family", "splines"])
    said = " ".join(capsys.readouterr().err.split())
    assert "argument --family: “splines” is not a family; use lagrange, hermite, quintic_hermite" in said
    assert all(family.name in said for family in FAMILIES)


def test_converting_there_and_back_gives_the_same_document(tmp_path, capsys):
    table, thinned, drawing = (tmp_path / name for name in ("a.csv", "b.curve.json", "c.svg"))
    assert main(["convert", LETTER, str(table), "--by", "length", "--samples", "2000"]) == 0
    assert main(["convert", str(table), str(thinned), "--thin", "1e-3"]) == 0
    assert float(capsys.readouterr().out.split()[-1]) <= 1e-3
    assert 5 < len(load(thinned).curves[0].points) < 100
    assert main(["convert", str(thinned), str(drawing)]) == 0
    assert main(["convert", str(drawing), str(tmp_path / "d.dxf")]) == 0
    assert main(["info", str(thinned)]) == 0
    assert "length           about 23.0" in capsys.readouterr().out


@pytest.mark.usefixtures("drawings_read_here")
def test_convert_reports_content_left_out(tmp_path, capsys):
    path = tmp_path / "a.svg"
    path.write_text('<svg><text/><path d="M0 0L1 1"/></svg>', encoding="utf-8")
    assert main(["convert", str(path), str(tmp_path / "a.py")]) == 0
    assert capsys.readouterr().err == "curvebench: 1 text left out.\n"


def test_convert_refuses_in_one_line(tmp_path, capsys):
    bad = tmp_path / "bad.csv"
    bad.write_text("x,y\n1,2\n=cmd,3\n", encoding="utf-8")
    line = refusal(capsys, "convert", str(bad), str(tmp_path / "a.py"))
    assert line == "“bad.csv” cannot be read: Row 3, column 1: “=cmd” is a formula; only numbers are read."
    assert "known file extension" in refusal(capsys, "convert", LETTER, str(tmp_path / "a.bmp"))
    assert "known file extension" in refusal(
        capsys, "convert", str(tmp_path / "a.gif"), str(tmp_path / "a.py")
    )
    assert list(tmp_path.iterdir()) == [bad]


@each_row(
    "words",
    [
        ["render", LETTER],
        ["convert", LETTER],
        ["convert", LETTER, "a.csv", "b.csv"],
        ["convert", LETTER, "a.csv", "--surprise"],
        ["convert", LETTER, "a.csv", "-o", "b"],
        ["convert", LETTER, "a.csv", "-j", "2"],
        ["convert", LETTER, "--to", ".csv"],
        ["convert", LETTER, "--to", ".csv", "-o", "b", "-j", "0"],
        ["convert", LETTER, "a.csv", "--by", "luck"],
        ["convert", LETTER, "a.csv", "--thin", "-1"],
        ["render", LETTER, "-o", "a.svg", "--width", "0"],
        ["render", LETTER, "-o", "a.svg", "--width", "1" * 5000],
        ["render", LETTER, "-o", "a.svg", "--tolerance", "nan"],
        ["render", LETTER, "-o", "a.svg", "--theme", "pink"],
        ["info"],
        ["--surprise"],
    ],
)
def test_wrong_usage_ends_with_code_2(words, capsys):
    with pytest.raises(SystemExit) as end:
        main(words)
    assert end.value.code == 2
    assert "usage: curvebench" in capsys.readouterr().err


def test_version_and_help(capsys):
    with pytest.raises(SystemExit) as end:
        main(["--version"])
    assert end.value.code == 0
    assert capsys.readouterr().out == f"curvebench {__version__}\n"
    with pytest.raises(SystemExit):
        main(["--help"])
    text = capsys.readouterr().out
    assert "curvebench render FILE -o OUT" in text
    assert "./render" in text


def test_a_terminal_without_greek_still_shows_the_facts(monkeypatch):
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, "ascii"))
    assert main(["info", LETTER]) == 0
    sys.stdout.flush()
    assert raw.getvalue().startswith(b"Letter S")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device that is always full")
def test_output_that_cannot_be_written_is_reported():
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "app", "info", LETTER],
            stdout=full,
            stderr=subprocess.PIPE,
            cwd=ROOT,
            check=False,
            text=True,
        )
    assert done.returncode == 1
    assert done.stderr == "curvebench: The output cannot be written (No space left on device).\n"


# Qt looks at the locale with its first object: after a fork each process has one of its own. It is set there,
# for Python does not start from a folder with an umlaut in the locale C.
IN_LOCALES = """
import os, sys
from app.__main__ import main
import app.exchange.drawing.image
for name in ("C", "POSIX", "C.UTF-8"):
    if not (child := os.fork()):
        os.environ["LC_ALL"] = name
        sys.argv[-1] += f"/ä {name}.png"
        os._exit(main())
    assert os.waitpid(child, 0) == (child, 0)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="elsewhere Qt asks for no locale")
def test_in_no_locale_does_qt_write_to_stderr(tmp_path):
    """Four lines at every start: “Detected locale "C" with character encoding …, which is not UTF-8”."""
    done = run("render", LETTER, "--width", "90", "-o", str(tmp_path), code=IN_LOCALES)
    assert (done.returncode, done.stderr) == (0, "")
    assert {path.name for path in tmp_path.glob("*.png")} == {"ä C.png", "ä POSIX.png", "ä C.UTF-8.png"}


@pytest.mark.parametrize(
    ("problem", "said"),
    [
        (OSError("an odd one"), "an odd one"),
        (PermissionError(13, "Permission denied", "b.png"), "Permission denied: “b.png”"),
        (OSError(28, "No space left on device"), "No space left on device"),
        (TimeoutError(), "TimeoutError"),
    ],
)
def test_errors_of_the_system_are_reported(problem, said, monkeypatch, capsys):
    """It used to be "The output cannot be written (None)", whatever and wherever it was."""

    def fail(*_arguments, **_options):
        raise problem

    monkeypatch.setattr("app.cli.rendering.export", fail)
    assert refusal(capsys, "render", LETTER, "-o", "b.png") == (
        f"curvebench render {LETTER} -o b.png failed: {said}."
    )


def test_a_missing_temporary_folder_is_named(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "gone"))
    path = tmp_path / "a.svg"
    path.write_text("<svg/>", encoding="utf-8")
    said = refusal(capsys, "convert", str(path), "b.csv")
    missing = os.strerror(errno.ENOENT)
    assert said == f"“a.svg” cannot be read: The file cannot be passed to its reader process ({missing})."


def test_ctrl_c_is_quiet(monkeypatch, capsys):
    def interrupted(_path):
        raise KeyboardInterrupt

    monkeypatch.setattr("app.cli.documents.load_counting", interrupted)
    assert main(["info", LETTER]) == 130
    assert capsys.readouterr() == ("", "")


# Does one command after the other: to start a process takes longer than most of them.
COMMANDS = """
import sys
from app.cli import main
codes = [main(words.splitlines()) for words in sys.argv[1:]]
"""

WITHOUT_QT = """
assert not [name for name in sys.modules if name.startswith(("PySide6", "pyqtgraph"))]
"""


def test_info_and_svg_do_without_qt(tmp_path):
    words = (f"info\n{LETTER}", f"render\n{LETTER}\n-o\n{tmp_path / 'a.svg'}")
    done = run(*words, code=f"{COMMANDS}{WITHOUT_QT}assert codes == [0, 0]")
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "a.svg").stat().st_size > 1000


def test_pictures_need_no_display(tmp_path):
    targets = [tmp_path / name for name in ("a.png", "a.pdf")]
    words = [f"render\n{LETTER}\n-o\n{target}\n--width\n200" for target in targets]
    done = run(*words, code=f"{COMMANDS}assert codes == [0, 0]")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert all(target.stat().st_size > 1000 for target in targets)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere there is always a display")
def test_the_editor_without_a_display_suggests_the_other_commands():
    done = run(LETTER)
    assert done.returncode == 1
    assert done.stderr.startswith("curvebench: There is no display to open a window on.")
    assert done.stderr.count("\n") == 1


def test_the_package_runs_as_a_module():
    done = run("--version", code="import runpy; runpy.run_module('app', run_name='__main__')")
    assert done.stdout == f"curvebench {__version__}\n"


def test_a_closed_pipe_is_quiet():
    reader, writer = os.pipe()
    os.close(reader)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "app", "info", LETTER],
            stdout=writer,
            stderr=subprocess.PIPE,
            cwd=ROOT,
            check=False,
        )
    finally:
        os.close(writer)
    assert (done.returncode, done.stderr) == (0, b"")


def test_the_editor_opens_a_window_for_every_file(qapp, capsys):
    seen = []

    def look_and_close():
        windows = [widget for widget in qapp.topLevelWidgets() if isinstance(widget, QMainWindow)]
        for window in windows:
            seen.append((window.session.document.curves[0].name, window.isVisible()))
            window.close()
            window.deleteLater()

    QTimer.singleShot(0, look_and_close)
    assert main([LETTER, str(EXAMPLES / "robot_move.curve.json")]) == 0
    assert sorted(seen) == [("Letter S", True), ("Robot move", True)]
    assert capsys.readouterr() == ("", "")


def test_a_file_that_is_no_document_does_not_keep_the_other_files_from_opening(qtbot, tmp_path, capsys):
    """One line on stderr, “a.csv cannot be read: it is not JSON”, and no window for the document either."""
    table, bad, picture = tmp_path / "a.csv", tmp_path / "bad.curve.json", tmp_path / "a.png"
    table.write_text("0,0\n1,1\n", encoding="utf-8")
    bad.write_text("{", encoding="utf-8")
    Image.new("RGB", (4, 4)).save(picture)
    document = tmp_path / "good.curve.json"
    save(document, load(LETTER))
    seen = []

    def look_and_close(window):
        dialog = window.findChild(QDialog, "importTableDialog")
        if dialog is None:
            return
        timer.stop()
        editor = Editor.on(window)
        seen.append((window.session.files.path, dialog.windowTitle(), editor.message))
        seen.append(window.session.document.image.path)
        window.asks_before_closing = False
        window.close()

    def look():
        for window in QApplication.topLevelWidgets():
            if isinstance(window, QMainWindow) and window.isVisible():
                look_and_close(window)

    timer = QTimer(interval=5, timeout=look)
    timer.start()
    gone = tmp_path / "gone.csv"
    try:
        assert main([str(each) for each in (bad, table, document, picture, gone)]) == 0
    finally:
        timer.stop()
    assert capsys.readouterr().err == ""
    (path, title, message), image = seen
    assert (path, title, image) == (document, "Import a.csv", str(picture))
    assert message.startswith(
        f"“{bad}” cannot be read: it is not JSON; the file ends too early. There is no file “{gone}”"
    )


_INCH = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="1in" height="1in" viewBox="0 0 9 9">'
    '<path d="M0 0H9"/></svg>'
)


@pytest.mark.parametrize(
    ("name", "content", "dialog", "unit"),
    [
        ("dots.csv", "0,0\n1,1\n", "importTableDialog", ""),
        ("inch.svg", _INCH, "", "in"),
    ],
)
@pytest.mark.usefixtures("drawings_read_here")
def test_a_drawing_or_a_table_alone_is_the_document(qtbot, tmp_path, name, content, dialog, unit):
    path = tmp_path / name
    path.write_text(content, encoding="utf-8")
    (window,) = open_windows([str(path)])
    qtbot.addWidget(window)
    session = window.session
    if dialog:
        until(lambda: window.findChild(QDialog, dialog) is not None)
        assert session.files.is_untouched
        asked = window.findChild(QDialog, dialog)
        until(lambda: asked.ok.isEnabled() and not asked.jobs.is_busy)
        asked.ok.click()
    else:
        until(lambda: not session.files.is_untouched)
    document, stem = session.document, path.stem
    assert ([len(curve.points) for curve in document.curves], document.unit) == ([2], unit)
    assert (title_of(session), file_stem(session), session.files.path) == (stem, stem, None)
    assert not session.files.is_modified, "closing it asks nothing"
    assert not session.undo_stack.canUndo()


# What goes into a picture


def rendered(tmp_path, *words, ending="svg"):
    path = tmp_path / f"out.{ending}"
    assert main(["render", LETTER, "-o", str(path), *words]) == 0
    return path


def test_a_picture_has_the_options_of_the_dialog(tmp_path):
    plain = rendered(tmp_path).read_text(encoding="utf-8")
    full = rendered(tmp_path, "--points", "--handles", "--grid", "--basis").read_text(encoding="utf-8")
    for name in ("points", "handles", "grid", "basis"):
        assert f'id="{name}"' not in plain
        assert f'id="{name}"' in full
    assert rendered(tmp_path, "--no-points").read_text(encoding="utf-8") == plain


def test_a_dark_svg_without_paper(tmp_path):
    text = rendered(tmp_path, "--theme", "dark", "--transparent").read_text(encoding="utf-8")
    assert "#e6e8ea" in text
    assert 'id="paper"' not in text
    assert 'id="paper"' in rendered(tmp_path, "--theme", "dark").read_text(encoding="utf-8")


@pytest.mark.parametrize("ending", ["png", "svg"])
def test_a_picture_has_paper_only_with_a_theme(ending, tmp_path):
    images = pytest.importorskip("PySide6.QtGui")
    # As the window exports it; a PNG had light paper.
    for words, alpha in (((), 0), (("--theme", "light"), 255), (("--theme", "light", "--transparent"), 0)):
        path = rendered(tmp_path, "--width", "100", *words, ending=ending)
        if ending == "png":
            assert images.QImage(str(path)).pixelColor(0, 0).alpha() == alpha
        else:
            assert ('id="paper"' in path.read_text(encoding="utf-8")) is bool(alpha)


def test_a_sharper_png_without_paper(tmp_path):
    images = pytest.importorskip("PySide6.QtGui")
    plain = images.QImage(str(rendered(tmp_path, "--width", "300", "--theme", "light", ending="png")))
    sharp = rendered(tmp_path, "--width", "300", "--scale", "2", ending="png")
    image = images.QImage(str(sharp))
    assert (plain.width(), image.width()) == (300, 600)
    assert image.dotsPerMeterX() == pytest.approx(2 * plain.dotsPerMeterX(), abs=2)
    assert plain.pixelColor(0, 0).alpha() == 255
    assert image.pixelColor(0, 0).alpha() == 0


def test_the_basis_of_a_missing_curve_is_refused(capsys, tmp_path):
    out = str(tmp_path / "a.svg")
    said = refusal(capsys, "render", LETTER, "-o", out, "--basis", "7")
    assert said == "There is no curve 7; the document has 1."
    assert not Path(out).exists()


def test_a_picture_beyond_the_limit_of_pixels_is_refused(capsys, tmp_path):
    said = refusal(capsys, "render", LETTER, "-o", str(tmp_path / "a.png"), "--scale", "1e300")
    assert "its sides can be 1 to 16384 pixels" in said


def test_convert_accepts_columns_and_corners(capsys, tmp_path):
    table = tmp_path / "a.csv"
    words = ["convert", LETTER, str(table), "--samples", "2000", "--columns", "x,y"]
    assert main(words) == 0
    assert table.read_text(encoding="utf-8").startswith("x,y\n")
    back = tmp_path / "a.curve.json"
    assert main(["convert", str(table), str(back), "--thin", "0.01", "--corners"]) == 0
    assert 10 < len(load(back).curves[0].points) < 400
    capsys.readouterr()
    assert "at least one is needed" in refusal(capsys, "convert", LETTER, str(table), "--columns", "z")


def test_convert_puts_points_into_a_dxf(capsys, tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    out = tmp_path / "a.dxf"
    assert main(["convert", LETTER, str(out), "--points"]) == 0
    drawing = ezdxf.readfile(out)
    kinds = [entity.dxftype() for entity in drawing.modelspace()]
    assert (kinds.count("SPLINE"), kinds.count("POINT")) == (1, 9)
    assert not drawing.audit().errors
    assert main(["convert", str(EXAMPLES / "robot_move.curve.json"), str(out), "--cubic"]) == 0
    assert [spline.dxf.degree for spline in ezdxf.readfile(out).modelspace()] == [3]


def test_convert_states_whether_the_deviation_is_a_bound(capsys, tmp_path):
    source, out = tmp_path / "a.csv", str(tmp_path / "a.svg")
    source.write_text("x,y\n0,0\n1,2\n2,-1\n3,1\n4,0\n5,2\n", encoding="utf-8")
    for family, word in (("lagrange", ""), ("floater_hormann", "about ")):
        assert main(["convert", str(source), out, "--family", family]) == 0
        said = capsys.readouterr().out.strip()
        assert re.search(
            rf"largest deviation from the true curves {word}[\d.e-]+ \(automatic tolerance 0\.0002\)$", said
        )
        assert f"true curves: {word}" in Path(out).read_text(encoding="utf-8")
        assert main(["convert", str(source), out, "--family", family, "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["deviation_is_bound"] is (not word)


def test_convert_refuses_too_few_digits_of_a_formula_and_writes_enough(capsys, tmp_path):
    near, out = tmp_path / "near.csv", tmp_path / "near.tex"
    near.write_text("x,y\n0,0\n1,0\n1.00000001,0\n2,1\n", encoding="utf-8")
    assert "Use 8 or more" in refusal(capsys, "convert", str(near), str(out))
    assert main(["convert", str(near), str(out), "--digits", "9"]) == 0
    assert "1.00000001" in out.read_text(encoding="utf-8")


def test_render_writes_a_motion(tmp_path, capsys):
    gif, png = tmp_path / "move.gif", tmp_path / "move.png"
    words = ["render", LETTER, "--width", "64", "--fps", "10"]
    assert main([*words, "-o", str(gif), "--seconds", "0.4"]) == 0
    assert main([*words, "-o", str(png), "--motion", "ping-pong", "--pace", "length"]) == 0
    assert capsys.readouterr() == ("", "")
    with Image.open(gif) as film:
        assert (film.n_frames, film.width, film.info["loop"]) == (4, 64, 0)
    with Image.open(png) as film:
        # The domain is [0, 1]: to and fro takes two seconds.
        assert (film.n_frames, film.width) == (20, 64)
    too_long = refusal(capsys, *words, "-o", str(gif), "--seconds", "1000")
    assert "1200 frames" in too_long


def test_version_and_help_need_no_numpy():
    for option in ("--version", "--help"):
        code = (
            "import sys\nfrom app.cli import main\ntry:\n    main([sys.argv[1]])\n"
            "except SystemExit:\n    print('numpy' in sys.modules)\n"
        )
        assert run(option, code=code).stdout.splitlines()[-1] == "False"


@pytest.mark.parametrize("name", ["a.svg", "a.csv"])
@pytest.mark.usefixtures("drawings_read_here")
def test_a_file_that_is_refused_at_the_start_leaves_an_empty_window(qtbot, tmp_path, name):
    """The first sketch was there, as if it were what the file holds."""
    path = tmp_path / name
    path.write_bytes(b"\x1f\x8b no")
    (window,) = open_windows([str(path)])
    qtbot.addWidget(window)
    bar = window.context.central.message_bar
    until(lambda: name in bar.text)
    assert [len(curve.points) for curve in window.session.document.curves] == [0]
    assert window.session.files.is_untouched
    assert not window.session.undo_stack.canUndo()
