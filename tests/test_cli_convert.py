"""The command ``convert`` with many files."""

import io
import json
import re
import sys
from xml.etree import ElementTree

import pytest

from app.cli import converting, main
from app.storage.files import load

TABLE = "0,0\n1,2\n3,1\n"
REMARK = "Columns: x = column 1, y = column 2."
DRAWING = '<svg xmlns="http://www.w3.org/2000/svg"><text/><path d="M0 0C1 1 2 2 3 0"/></svg>'


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The working folder, with four tables; “bad.csv” is none."""
    for name in ("a", "b", "c"):
        (tmp_path / f"{name}.csv").write_text(TABLE)
    (tmp_path / "bad.csv").write_text("1,2\n1,3\n=cmd,3\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def written(folder):
    """The files below the folder."""
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*/*") if path.is_file())


def test_many_files_are_converted_into_a_new_folder(folder, capsys):
    assert main(["convert", "a.csv", "b.csv", "-o", "made/of/two", "--to", ".curve.json"]) == 0
    assert written(folder) == ["made/of/two/a.curve.json", "made/of/two/b.curve.json"]
    assert len(load(folder / "made/of/two/b.curve.json").curves[0].points) == 3
    output = capsys.readouterr()
    assert [line.partition(":")[0] for line in output.out.splitlines()] == [
        "made/of/two/a.curve.json",
        "made/of/two/b.curve.json",
    ]
    assert output.err.splitlines() == [f"curvebench: {name}.csv: {REMARK}" for name in "ab"]


def test_options_between_the_files_and_several_input_files_are_accepted(folder, capsys):
    """IN and OUT may be parted by an option, as they always could."""
    assert main(["convert", "a.csv", "--family", "lagrange", "a.curve.json"]) == 0
    assert load(folder / "a.curve.json").curves[0].family.name == "lagrange"
    assert main(["convert", "--to", "svg", "a.curve.json", "-o", "one"]) == 0
    assert main(["convert", "a.csv", "-o", "two", "b.csv", "--to", "svg", "c.csv"]) == 0
    assert written(folder) == ["one/a.svg", "two/a.svg", "two/b.svg", "two/c.svg"]


def test_a_failed_conversion_is_reported_in_a_line_and_the_others_continue(folder, capsys):
    files = ["a.csv", "bad.csv", "nowhere.csv", "x.gif", "b.csv"]
    assert main(["convert", *files, "-o", "out", "--to", ".curve.json"]) == 1
    output = capsys.readouterr()
    bad, nowhere, unknown = (line for line in output.err.splitlines() if REMARK not in line)
    assert bad.startswith("curvebench: “bad.csv” cannot be read: Row 3, column 1")
    assert nowhere.startswith("curvebench: There is no file “nowhere.csv”")
    assert unknown.startswith("curvebench: The name “x.gif” has no known file extension")
    assert output.out.count("\n") == 2
    assert written(folder) == ["out/a.curve.json", "out/b.curve.json"]


def test_a_line_on_a_failure_names_its_file(folder, capsys, monkeypatch):
    def full(*_arguments, **_options):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(converting, "export", full)
    assert main(["convert", "a.csv", "b.csv", "-o", "out", "--to", "svg"]) == 1
    assert capsys.readouterr().err.splitlines() == [
        f"curvebench: “{name}.csv”: No space left on device." for name in "ab"
    ]


def test_the_results_as_json(folder, capsys):
    words = ["convert", "a.csv", "bad.csv", "-o", "out", "--to", ".curve.json", "--json"]
    assert main(words) == 1
    output = capsys.readouterr()
    good, bad = json.loads(output.out)
    exact = {"deviation": 0.0, "deviation_is_bound": True}
    assert good == {"input": "a.csv", "output": "out/a.curve.json", **exact, "remarks": [REMARK]}
    assert bad["input"] == "bad.csv"
    assert output.err == f"curvebench: {bad['error']}\n"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ["a.csv", "sub/a.csv", "-o", "out", "--to", "svg"],
            "“a.csv” and “sub/a.csv” would both be written to “out/a.svg”",
        ),
        (["a.csv", "a.tsv", "-o", "out", "--to", "svg"], "“a.csv” and “a.tsv” would both be written"),
        (["b.csv", "b.csv", "-o", "out", "--to", "svg"], "“b.csv” and “b.csv” would both be written"),
        (["a.csv", "-o", ".", "--to", ".csv"], "“a.csv” would overwrite “a.csv”"),
        (["b.csv", "link.tsv", "-o", "sub", "--to", ".csv"], "“b.csv” would overwrite “link.tsv”"),
        (["b.csv", "-o", "c.csv", "--to", "svg"], "“c.csv” is not a folder"),
        (["b.csv", "-o", "c.csv/d", "--to", "svg"], "The folder “c.csv/d” cannot be created"),
        (["b.csv", "-o", "out", "--to", ".bmp"], "has no known file extension"),
        (["b.csv", "-o", "out", "--to", "svg", "--keep-times"], "--keep-times needs --fit"),
        (["b.csv", "-o", "out", "--to", "svg", "--setting", "x=1"], "--setting must be of"),
    ],
)
def test_nothing_is_written_where_something_would_be_lost(words, said, folder, capsys):
    (folder / "sub").mkdir()
    (folder / "sub/a.csv").write_text(TABLE)
    (folder / "a.tsv").write_text(TABLE.replace(",", "\t"))
    (folder / "link.tsv").write_text(TABLE.replace(",", "\t"))
    (folder / "sub/b.csv").hardlink_to(folder / "link.tsv")
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert main(["convert", *words]) == 1
    output = capsys.readouterr()
    assert output.err.count("\n") == 1
    assert said in output.err
    assert output.out == ""
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before
    assert not (folder / "out").exists()


@pytest.mark.parametrize(("jobs", "count"), [([], 1), (["-j", "2"], 2), (["-j", "9"], 3)])
def test_a_process_reads_one_drawing_after_the_other(jobs, count, folder, capsys, children):
    for name in ("a.svg", "bad.svg", "c.svg"):
        (folder / name).write_text(DRAWING.replace("svg", "png" if name == "bad.svg" else "svg"))
    assert main(["convert", "a.svg", "bad.svg", "c.svg", "-o", "out", "--to", ".curve.json", *jobs]) == 1
    output = capsys.readouterr()
    assert output.err.splitlines() == [
        "curvebench: a.svg: 1 text left out.",
        "curvebench: “bad.svg” cannot be read: This is not an SVG file: it begins with <png>.",
        "curvebench: c.svg: 1 text left out.",
    ]
    assert written(folder) == ["out/a.curve.json", "out/c.curve.json"]
    assert len(children) == count
    assert all(each.returncode is not None for each in children)


def test_large_drawings_have_several_processes(folder, monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 4)
    (folder / "large.csv").write_bytes(b" " * 10**6)

    def jobs(files, wanted=None):
        return converting._jobs(type("Options", (), {"files": files, "jobs": wanted}))

    assert jobs(["a.csv", "b.csv", "c.csv", "nowhere.csv"]) == 1
    assert jobs(["a.csv", "large.csv"]) == 2
    assert jobs(["a.csv"] * 8 + ["large.csv"]) == 3
    assert jobs(["a.csv", "large.csv"] * 8) == 4
    assert jobs(["a.csv", "large.csv"], 1) == 1


def test_a_terminal_displays_the_number_of_the_current_file(folder, monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    monkeypatch.setattr("app.cli.output.PATIENCE", -1.0)
    monkeypatch.setattr(sys, "stderr", terminal := Terminal())
    assert main(["convert", "a.csv", "bad.csv", "c.csv", "-o", "out", "--to", "svg"]) == 1
    told = terminal.getvalue()
    assert "\ra.csv (1 of 3): " in told
    assert "\rc.csv (3 of 3): " in told
    # Nothing is printed behind the line.
    assert "\r\033[Kcurvebench: “bad.csv” cannot be read" in told
    assert told.rpartition("%\033[K")[2].startswith("\r\033[K")
    shares = [int(each.rpartition(" ")[2].rstrip("%\033[K")) for each in told.split("\r") if "%" in each]
    assert shares == sorted(shares)


def test_convert_and_render_take_scale_and_decimals_of_an_svg(folder):
    assert main(["convert", "a.csv", "a.curve.json"]) == 0
    options = ["--svg-scale", "10", "--decimals", "1"]
    assert main(["convert", "a.csv", "one.svg", *options]) == 0
    assert main(["render", "a.curve.json", "-o", "two.svg", *options]) == 0
    for name in ("one.svg", "two.svg"):
        root = ElementTree.fromstring((folder / name).read_bytes())
        assert float(root.get("width")) == pytest.approx(10 * float(root.get("viewBox").split()[2]), rel=1e-5)
        data = next(root.iter("{http://www.w3.org/2000/svg}path")).get("d")
        # One decimal of a pixel, of which ten are a unit.
        assert max(map(len, re.findall(r"\.(\d+)", data))) == 2
