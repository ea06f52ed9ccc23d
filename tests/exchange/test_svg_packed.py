"""SVG packed by gzip: read, written the same at any time, and never more of it unpacked than is sane."""

from __future__ import annotations

import gzip
import subprocess
import zlib

import pytest

from app.cli import main
from app.exchange.errors import ExchangeError
from app.exchange.reading import import_file
from app.exchange.svg import compressed
from app.exchange.writing import export

SVG = b"""<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="10mm" viewBox="0 0 10 10">
<!-- kept --><path id="a" d="M1 1 L9 1 L9 9 Z" fill="#ff0000"/></svg>"""


@pytest.fixture
def packed_file(tmp_path):
    path = tmp_path / "a.svgz"
    path.write_bytes(gzip.compress(SVG))
    return path


def test_it_holds_what_the_drawing_in_it_holds(packed_file, tmp_path):
    plain = tmp_path / "a.svg"
    plain.write_bytes(SVG)
    assert import_file(packed_file).document == import_file(plain).document
    # Under the other name it is read as well, as Inkscape does.
    plain.write_bytes(packed_file.read_bytes())
    assert import_file(plain).document == import_file(packed_file).document


def test_what_is_written_is_the_plain_file_packed_and_the_same_at_any_time(packed_file, tmp_path):
    document = import_file(packed_file).document
    export(document, tmp_path / "b.svg")
    export(document, tmp_path / "b.svgz")
    written = (tmp_path / "b.svgz").read_bytes()
    assert gzip.decompress(written) == (tmp_path / "b.svg").read_bytes()
    # Bytes 4 to 7 are the time (RFC 1952, 2.3), and there is no name after them.
    assert written[4:8] == bytes(4)
    assert written[3] == 0
    said = subprocess.run(
        ["rsvg-convert", tmp_path / "b.svgz", "-o", tmp_path / "b.png"], check=False, capture_output=True
    )
    assert not said.stderr
    assert (tmp_path / "b.png").stat().st_size > 100


@pytest.mark.parametrize("times", [1, 2])
def test_a_bomb_is_stopped_before_it_is_unpacked(tmp_path, times):
    """A hundred megabytes of blanks take a hundred kilobytes, as one stream or as two."""
    path = tmp_path / "bomb.svgz"
    path.write_bytes(gzip.compress(b" " * (100 * 2**20 // times)) * times)
    with pytest.raises(ExchangeError, match="holds more than 64 MB; it was stopped"):
        import_file(path)


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda data: data[:-30], "is cut off"),
        (lambda data: data[:12] + bytes(8) + data[20:], "is damaged"),
        (lambda _data: b"\x1f\x8b", "is cut off"),
    ],
)
def test_what_is_cut_off_or_damaged_is_said(packed_file, spoil, said):
    packed_file.write_bytes(spoil(packed_file.read_bytes()))
    with pytest.raises(ExchangeError, match=said):
        import_file(packed_file)


def test_zeros_behind_the_stream_are_passed_over(packed_file):
    packed_file.write_bytes(packed_file.read_bytes() + bytes(512))
    assert len(import_file(packed_file).document.curves) == 1


def test_the_limit_counts_what_is_unpacked():
    assert compressed.unpacked(gzip.compress(b"x" * 2**20)) == b"x" * 2**20
    assert compressed.unpacked(SVG) == SVG
    assert zlib.crc32(compressed.unpacked(gzip.compress(SVG) + gzip.compress(SVG))) == zlib.crc32(SVG * 2)


def test_the_command_line_reads_and_writes_it(packed_file, tmp_path, capsys):
    assert main(["convert", str(packed_file), str(tmp_path / "b.svgz")]) == 0
    assert main(["render", str(packed_file), "-o", str(tmp_path / "b.png")]) == 0
    assert main(["info", str(packed_file)]) == 0
    assert "cubic Hermite" in capsys.readouterr().out
    assert b"<path" in gzip.decompress((tmp_path / "b.svgz").read_bytes())
