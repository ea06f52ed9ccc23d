"""Settings of a family: in curves of the core, in documents, in files."""

import copy
import json
import pickle

import numpy as np
import pytest
from msgspec.structs import replace

from app.document import limits, rule_edits
from app.document.model import Document, make_curve
from app.exchange.facts import facts_of
from app.families import FAMILIES, LAGRANGE, NO_SETTINGS, FamilySettingValues
from app.storage.format import decode, encode
from app.storage.format_error import FormatError
from app.storage.validation import validate
from app.view_model.curve.curve_view import view_of
from curvecore import Chain, CurveError, LagrangeCurve
from tests.own_families import EVERY
from tests.rows import each_row

POINTS = ((0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0))

pytestmark = pytest.mark.usefixtures("own_families")


@pytest.fixture
def swaying():
    return FAMILIES.named("tests_swaying")


@pytest.fixture
def document(swaying):
    return Document((make_curve(POINTS, family=swaying),))


def jets():
    return np.array(POINTS)[:, None]


def make(family, **settings):
    made = family.make(jets(), [0.0, 1.0, 2.0, 3.0])
    return type(made).from_jets(made.jets, made.parameters, **settings)


# Curves of the core


def test_a_curve_has_the_defaults(swaying):
    assert make(swaying).chosen == {"amount": 2, "first_side": "left"}


def test_a_setting_changes_the_functions_and_not_the_points(swaying):
    curve, other = make(swaying), make(swaying, amount=5, first_side="right")
    assert np.array_equal(curve.evaluate(curve.parameters), other.evaluate(curve.parameters))
    assert np.abs(curve.evaluate(0.5) - other.evaluate(0.5)).max() > 0.1
    assert curve.functions_key != other.functions_key


def test_other_data_keep_the_settings(swaying):
    curve = make(swaying, amount=5)
    for other in (curve.with_jets(2.0 * curve.jets), curve.with_data(curve.jets, [0.0, 1.0, 2.0, 4.0])):
        assert other.chosen == curve.chosen
        assert other.functions_key == curve.functions_key


def test_copies_keep_the_settings(swaying):
    curve = make(swaying, amount=5)
    assert copy.copy(curve).chosen == copy.deepcopy(curve).chosen == curve.chosen
    # A class of a file cannot be found again by a pickle; what it would hold can.
    state = pickle.loads(pickle.dumps(curve.__getstate__()))
    again = object.__new__(type(curve))
    again.__setstate__(state)
    assert again.functions_key == curve.functions_key


def test_a_chain_has_the_settings_of_its_pieces(swaying):
    curve = make(swaying, amount=5)
    chain = Chain([curve, swaying.make(jets() + jets()[-1], [3.0, 4.0, 5.0, 6.0], {"amount": 5})])
    assert chain.chosen == curve.chosen
    assert chain.with_jets(chain.jets).functions_key == curve.functions_key


@each_row(
    ("settings", "words"),
    [
        ({"amount": 10}, "amount must be a whole number from 0 to 9, not 10"),
        ({"amount": 2.0}, "amount must be a whole number from 0 to 9, not 2.0"),
        ({"amount": True}, "amount must be a whole number from 0 to 9, not True"),
        ({"first_side": "up"}, "first_side must be one of left, right, not 'up'"),
        ({"speed": 1}, "swaying has no setting speed"),
    ],
)
def test_a_value_outside_of_its_limits_is_refused(swaying, settings, words):
    with pytest.raises(CurveError, match=words):
        make(swaying, **settings)


def test_a_family_without_settings_refuses_any():
    with pytest.raises(CurveError, match="Lagrange has no setting amount"):
        LagrangeCurve.from_jets(jets(), [0, 1, 2, 3], amount=1)


def test_numbers_of_numpy_become_plain(swaying):
    assert type(make(swaying, amount=np.int64(4)).chosen["amount"]) is int


# Every family's own settings


@each_row("name", EVERY)
def test_settings_of_the_registry_are_sound(name):
    names = [setting.name for setting in FAMILIES.named(name).settings.all]
    assert len(set(names)) == len(names)
    for setting in FAMILIES.named(name).settings.all:
        assert setting.name.isidentifier()
        assert setting.allows(setting.default)
        assert setting.title == setting.title.strip() != ""
        assert setting.tip
        assert (setting.limits is None) is bool(setting.choices)
        assert setting.text_of(setting.default)


# Documents


@pytest.fixture
def spline_document():
    return Document((make_curve(POINTS, family=FAMILIES.named("cardinal_spline")),))


def test_a_real_setting_is_stored_as_a_number(spline_document):
    tense = rule_edits.set_family_setting(spline_document, 0, "tension", 0.35)
    assert b'"settings": {"tension": 0.35}' in encode(tense)
    assert decode(encode(tense)) == tense
    assert view_of(tense.curves[0]).curve.chosen == {"tension": 0.35}
    third = rule_edits.set_family_setting(spline_document, 0, "tension", 1 / 3)
    assert decode(encode(third)).curves[0].settings["tension"] == 1 / 3
    # The default, whichever way it is written, is left out.
    for zero in (0, 0.0, -0.0):
        assert rule_edits.set_family_setting(tense, 0, "tension", zero) == spline_document


def test_a_real_setting_in_a_file_may_be_a_whole_number(spline_document):
    tense = decode(with_settings(spline_document, '{"tension": 1}'))
    assert tense == rule_edits.set_family_setting(spline_document, 0, "tension", 1.0)
    assert view_of(tense.curves[0]).curve.chosen == {"tension": 1.0}
    assert b'"settings": {"tension": 1}' in encode(tense)


def test_a_real_setting_outside_of_its_limits_is_refused(spline_document):
    with pytest.raises(limits.EditError, match=r"^Tension must be a number from −1 to 1\.$"):
        rule_edits.set_family_setting(spline_document, 0, "tension", 1.5)
    with pytest.raises(FormatError, match=r"settings\.tension must be a number from -1 to 1, not 1\.5"):
        decode(with_settings(spline_document, '{"tension": 1.5}'))
    with pytest.raises(FormatError, match=r'settings\.tension must be a number from -1 to 1, not "tight"'):
        decode(with_settings(spline_document, '{"tension": "tight"}'))


def test_the_document_holds_values_that_are_not_defaults(document):
    chosen = rule_edits.set_family_setting(document, 0, "amount", 5)
    assert dict(chosen.curves[0].settings) == {"amount": 5}
    assert rule_edits.set_family_setting(chosen, 0, "amount", 2) == document
    assert rule_edits.set_family_setting(document, 0, "amount", 2) is document


def test_an_edit_refuses_values_that_the_family_refuses(document):
    with pytest.raises(limits.EditError, match=r"^Amount of sway must be a whole number from 0 to 9\.$"):
        rule_edits.set_family_setting(document, 0, "amount", 10)
    with pytest.raises(limits.EditError, match="has no setting"):
        rule_edits.set_family_setting(document, 0, "speed", 1)


def test_another_family_begins_with_its_defaults_and_going_back_gives_the_same_curve(document, swaying):
    chosen = rule_edits.set_family_setting(document, 0, "amount", 5)
    assert rule_edits.set_family(chosen, 0, swaying) == chosen
    away = rule_edits.set_family(chosen, 0, LAGRANGE)
    assert away.curves[0].settings is NO_SETTINGS
    assert decode(encode(away)) == away
    rational = rule_edits.set_family_setting(
        rule_edits.set_family(away, 0, FAMILIES.named("floater_hormann")), 0, "degree", 1
    )
    assert decode(encode(rational)) == rational
    back = rule_edits.set_family(rational, 0, swaying)
    assert back.curves[0].settings == chosen.curves[0].settings
    assert dict(rule_edits.set_family(back, 0, FAMILIES.named("floater_hormann")).curves[0].settings) == {
        "degree": 1
    }
    assert rule_edits.set_family(away, 0, swaying) == chosen


def test_the_view_follows_the_settings(document):
    view = view_of(document.curves[0])
    other = view_of(rule_edits.set_family_setting(document, 0, "amount", 7).curves[0], view)
    assert other.curve.chosen == {"amount": 7, "first_side": "left"}
    assert np.abs(other.curve.evaluate(0.1) - view.curve.evaluate(0.1)).max() > 0.0
    assert other.growth > view.growth


def test_facts_have_all_settings(document):
    facts = facts_of(rule_edits.set_family_setting(document, 0, "amount", 7))[0]
    assert {setting.name: value for setting, value in facts.settings.items()} == {
        "amount": 7,
        "first_side": "left",
    }


def test_settings_are_compared_by_value():
    chosen = FamilySettingValues({"amount": 5, "side": "left"})
    assert chosen == FamilySettingValues([("side", "left"), ("amount", 5)])
    assert hash(chosen) == hash(FamilySettingValues([("side", "left"), ("amount", 5)]))
    assert chosen != FamilySettingValues({"amount": 4, "side": "left"})
    assert pickle.loads(pickle.dumps(chosen)) == copy.deepcopy(chosen) == chosen
    assert pickle.loads(pickle.dumps(NO_SETTINGS)) is FamilySettingValues({}) is NO_SETTINGS


def test_a_family_that_lost_a_setting_draws_edits_and_saves_its_curves(document, swaying):
    """As when its file is written anew while the document is open."""
    chosen = rule_edits.set_family_setting(document, 0, "amount", 5)
    stale = replace(
        chosen.curves[0], settings=FamilySettingValues({"speed": 3, "amount": 50, "first_side": "right"})
    )
    assert view_of(stale).curve.chosen == {"amount": 2, "first_side": "right"}
    open_document = Document((stale,))
    validate(open_document)
    assert dict(decode(encode(open_document)).curves[0].settings) == {"first_side": "right"}
    mended = rule_edits.set_family_setting(open_document, 0, "amount", 7)
    assert dict(mended.curves[0].settings) == {"first_side": "right", "amount": 7}


# Files


def with_settings(document, text):
    content = json.loads(encode(document))
    content["curves"][0]["settings"] = "HERE"
    return json.dumps(content).replace('"HERE"', text).encode()


def test_files_leave_out_defaults(document):
    assert b"settings" not in encode(document)
    chosen = rule_edits.set_family_setting(document, 0, "amount", 5)
    chosen = rule_edits.set_family_setting(chosen, 0, "first_side", "right")
    assert b'"settings": {"amount": 5, "first_side": "right"}' in encode(chosen)
    assert decode(encode(chosen)) == chosen


@pytest.mark.parametrize("text", ["{}", '{"amount": 2}', '{"first_side": "left", "amount": 2}'])
def test_defaults_in_a_file_are_left_out(document, text):
    assert decode(with_settings(document, text)) == document


@each_row(
    ("text", "words"),
    [
        ('{"amount": 10}', "curves[0].settings.amount must be a whole number from 0 to 9, not 10"),
        ('{"amount": 2.5}', "curves[0].settings.amount must be a whole number from 0 to 9, not 2.5"),
        ('{"amount": true}', "curves[0].settings.amount must be a whole number from 0 to 9, not true"),
        ('{"amount": null}', "curves[0].settings.amount must be a whole number from 0 to 9, not null"),
        ('{"amount": [1]}', "curves[0].settings.amount must be a whole number from 0 to 9, not a list"),
        ('{"amount": "x"}', 'curves[0].settings.amount must be a whole number from 0 to 9, not "x"'),
        ('{"first_side": "up"}', 'curves[0].settings.first_side must be one of left, right, not "up"'),
        ('{"speed": 1}', 'curves[0].settings has a key that tests_swaying does not know: "speed"'),
        ("[]", "curves[0].settings must be an object {…}, not a list"),
        ("null", "curves[0].settings must be an object {…}, not null"),
        (
            '{"amount": 1, "amount": 1}',
            "curves[0].settings.amount appears twice; each key may appear only once",
        ),
    ],
)
def test_files_are_strict(document, text, words):
    with pytest.raises(FormatError) as problem:
        decode(with_settings(document, text))
    assert str(problem.value) == words


@each_row(
    ("text", "words"),
    [
        (
            '[["floater_hormann", {"degree": 99}]]',
            "[0][1].degree must be a whole number from 0 to 10, not 99",
        ),
        ('[["hermite", {"x": 1}]]', '[0][1] has a key that hermite does not know: "x"'),
        (
            '[["tests_swaying", {"amount": 1}]]',
            "[0] must be of another family than those before it, not tests_swaying",
        ),
        ("[1]", "[0] must be a list, not a whole number"),
        ('[["hermite"]]', "[0] must be a list of 2 numbers"),
    ],
)
def test_files_are_strict_about_other_families(document, text, words):
    data = with_settings(document, "{}").replace(b'"settings": {}', f'"other_settings": {text}'.encode())
    with pytest.raises(FormatError) as problem:
        decode(data)
    assert str(problem.value).startswith("curves[0].other_settings")
    assert words in str(problem.value)


def test_settings_of_a_missing_family_are_saved(document):
    away = rule_edits.set_family(rule_edits.set_family_setting(document, 0, "amount", 5), 0, LAGRANGE)
    text = encode(away).replace(b"tests_swaying", b"not_here")
    assert b'"other_settings": [["not_here", {"amount": 5}]]' in text
    assert encode(decode(text)) == text


def test_a_missing_family_keeps_its_settings(document):
    chosen = rule_edits.set_family_setting(document, 0, "amount", 5)
    text = encode(chosen).replace(b"tests_swaying", b"not_here")
    assert encode(decode(text)) == text
    real = text.replace(b'{"amount": 5}', b'{"amount": 5.5}')
    assert encode(decode(real)) == real
    for bad in (
        b'{"Amount!": 5}',
        b'{"amount": 1e300}',
        b'{"amount": true}',
        b'{"amount": 1000000000000000}',
    ):
        with pytest.raises(FormatError, match=r"curves\[0\]\.settings"):
            decode(text.replace(b'{"amount": 5}', bad))
