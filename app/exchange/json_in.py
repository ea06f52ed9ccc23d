"""JSON of other programs in, as values of a type."""

from __future__ import annotations

import codecs
from typing import TypeVar

import msgspec

from ..storage.format_error import in_words, not_json
from .errors import ExchangeError

MOST_BYTES = 32 * 2**20
"""Of a JSON file: as Python's own numbers it takes several times as much."""

Content = TypeVar("Content")


def json_in(data: bytes, kind: type[Content]) -> Content:
    """Return the content of a JSON file.

    Raises
    ------
    ExchangeError
        With the place, for what is no JSON, or not of that type; for more than `MOST_BYTES`.
    """
    if len(data) > MOST_BYTES:
        raise ExchangeError(f"A JSON file may have {MOST_BYTES >> 20} MB; this one has more.")
    try:
        return msgspec.json.decode(data.removeprefix(codecs.BOM_UTF8), type=kind)
    except UnicodeDecodeError:
        raise ExchangeError("It is not UTF-8 text.") from None
    except msgspec.ValidationError as problem:
        raise ExchangeError(_sentence(in_words(str(problem)))) from None
    except msgspec.DecodeError as problem:
        raise ExchangeError(_sentence(not_json(str(problem), data))) from None
    except RecursionError:
        raise ExchangeError("The file is nested too deeply.") from None


def is_object(data: bytes) -> bool:
    """Whether a content begins as a JSON object does."""
    return data[:64].lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"{"


def _sentence(clause: str) -> str:
    return f"{clause[0].upper()}{clause[1:]}."
