"""Keys that an object has twice, at every place that a file has."""

import json

import pytest
from msgspec.structs import replace

from app.document.model import Document, Parametrization, ParametrizationKind, Point, make_curve
from app.storage.format import decode, encode
from app.storage.format_error import FormatError

NODES = (
    Point(0.0, 1.0, 0.0, velocity=(1.0, 2.0)),
    Point(2.0, 1.5, 0.5, acceleration=(0.0, 3.0)),
    Point(3.0, 1.0, 1.0, velocity=(1.0, 2.0), corner=True, velocity_after=(2.0, 2.0)),
)
PLAIN = make_curve([(0.0, 0.0), (1.0, 2.0)])
MANUAL = replace(PLAIN, points=NODES, parametrization=Parametrization(ParametrizationKind.MANUAL))
CONTENT = json.loads(encode(Document((PLAIN, MANUAL, PLAIN))))
# A key that may be left out is: it must not make up for one that is there twice.
del CONTENT["curves"][1]["parametrization"]["alpha"]


def places_of(value, place=()):
    """The places of all keys."""
    for key, each in value.items() if isinstance(value, dict) else enumerate(value):
        if isinstance(value, dict):
            yield (*place, key)
        if isinstance(each, dict | list):
            yield from places_of(each, (*place, key))


def written(value, doubled=(), escaped=False):
    """JSON, with the key at the place `doubled` written twice, the second time with an escaped letter."""
    if isinstance(value, dict):
        members = []
        for key, each in value.items():
            text = written(each, doubled[1:] if doubled[:1] == (key,) else (), escaped)
            members.append(f"{json.dumps(key)}: {text}")
            if doubled == (key,):
                again = f'"\\u{ord(key[0]):04x}{key[1:]}"' if escaped else json.dumps(key)
                members.append(f"{again}: {text}")
        return f"{{{', '.join(members)}}}"
    if isinstance(value, list):
        items = (
            written(each, doubled[1:] if doubled[:1] == (index,) else (), escaped)
            for index, each in enumerate(value)
        )
        return f"[{', '.join(items)}]"
    return json.dumps(value)


def in_words(place):
    return "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in place).removeprefix(".")


@pytest.mark.parametrize("escaped", [False, True])
def test_a_repeated_key_is_refused_in_any_object(escaped):
    assert decode(written(CONTENT).encode()).curves == (PLAIN, MANUAL, PLAIN)
    places = list(places_of(CONTENT))
    assert len(places) > 40
    for place in places:
        with pytest.raises(FormatError) as refusal:
            decode(written(CONTENT, place, escaped).encode())
        assert str(refusal.value).startswith(f"{in_words(place)} appears twice;"), place


def test_a_written_default_is_no_repeated_key():
    content = json.loads(json.dumps(CONTENT))
    content["curves"][0]["points"][1] |= {"t": None, "corner": False}
    assert decode(written(content).encode()).curves == (PLAIN, MANUAL, PLAIN)
    with pytest.raises(FormatError, match=r"^curves\[0\]\.points\[1\]\.corner appears twice"):
        decode(written(content, ("curves", 0, "points", 1, "corner")).encode())
