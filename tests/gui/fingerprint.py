"""What can be told of a window: whether it is as a new one is asked of this."""

from __future__ import annotations

import enum
import sys
from collections.abc import Collection, Mapping
from operator import is_
from pathlib import PurePath
from types import BuiltinFunctionType, FunctionType, MethodType

import msgspec
from PySide6.QtCore import QObject, QRegularExpression
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QAbstractButton, QDockWidget, QLabel, QTabWidget, QWidget

_FUNCTIONS = (FunctionType, BuiltinFunctionType, MethodType)
"""What tests replace: a clock, a question to the person."""

_PLAIN = (bool, int, float, str, bytes, type(None), enum.Enum, PurePath)

_ABSENT = object()

_OUR_NAMES = QRegularExpression("^(?!qt_|_q_|ScrollLeftButton$|ScrollRightButton$).")
"""Not those of Qt: the last two are what a row of tabs is scrolled with, as wide as it was last."""

# Looked up once: for every name that is asked of an object of its classes Qt for Python looks for features.
# An `isinstance` that is false asks for one, too.
_object_name, _is_checked, _is_enabled = QObject.objectName, QAction.isChecked, QAction.isEnabled
_is_visible, _text, _shortcut, _key_text = (
    QAction.isVisible,
    QAction.text,
    QAction.shortcut,
    QKeySequence.toString,
)
_is_visible_to, _is_widget_enabled, _tool_tip = QWidget.isVisibleTo, QWidget.isEnabled, QWidget.toolTip
_property, _current_index = QObject.property, QTabWidget.currentIndex

_LIBRARIES = {*sys.stdlib_module_names, "curvecore", "numpy", "pyqtgraph", "PySide6", "shiboken6", "Shiboken"}

PASSING = {
    # What was drawn last, and what is kept so that it need not be made again.
    *("_asked", "_axes", "_cost", "_costed", "_discs_key", "_drawn", "_extents", "_frozen", "_ghost"),
    *(
        "_ghost_stroke",
        "_ground",
        "_is_resting",
        "_italic",
        "_known",
        "_tools",
        "_pixmaps",
        "_reported_hints",
    ),
    *(
        "_cached_pen",
        "_pen_key",
        "Halo._key",
        "FunctionLines._cached",
        "CrestNames._sides_key",
        "CrestNames._sides_basis",
        "InkCache._key",
        "ImageLayer._key",
        "ColumnWidths._cache",
        "TeachingCommands._cached",
    ),
    *("_origin", "_pause", "_pens", "_pixels_of", "_room", "_seconds", "_stamps", "_stroke", "_strokes"),
    *("_upright", "_watcher", "__dict__", "is_due", "_autoRangeNeedsUpdate", "_painterPathCache"),
    *("BasisView.supports", "Cardinal.growth", "Cardinals._key", "CrestNames._crests_of"),
    *("CrestNames._pictures_key", "CrestNames._pictures", "Curve.has_derivatives", "CurveLayer._error_of"),
    *("CurveLayer._line", "CurveLayer.error", "DiskCommands._displayed", "EditedShapeLayer._line"),
    *(
        "FamilyButton._rendered",
        "FunctionLines._basis",
        "FunctionLines._envelopes",
        "FunctionLines._polygons",
    ),
    *("FunctionLines._polygons", "FunctionLines._pixel_map", "FunctionLines._stretches"),
    "FunctionLines._widths",
    *("GridLayer._pixel_map", "MotionLayer._plates"),
    *("MotionStage._courses", "MotionStage._rivals", "MotionStage._rivals_of", "MotionStage._scales"),
    *("PixelMap._known_rows", "PixelMap.box", "PlotCommands._curve_plots", "PlotCommands._plotted"),
    *("PlotCommands._was_calm", "PlotLayer._strokes_of", "PointLayer._discs", "PointLayer._kinds_key"),
    *("PointLayer._roles", "PointLayer._roles_arrays", "PointLayer._roles_key", "PointLayer.numbers"),
    *(
        "Rulers._band",
        "Rulers._marks",
        "Rulers._marks_theme",
        "ScrubLayer.scrub",
        "VisibleHandles._facing_counted",
    ),
    *("VisibleHandles._visible_at", "TickEdit._knot", "Toolbar._widths", "TraceLayer._lines"),
    *("SelectionBox._whole", "UsedColours._document_colours", "WiggleCommands._cures"),
    # Where the pointer was last, before it left, and with which button.
    *("_button", "_last", "Readouts._position", "_pointer", "Scrolling._zooms"),
    "SnapTargets._hovered",
    # A drag that is over until the next press; what was typed last, until more is; the panel named last.
    *("LiveSlider._is_over", "GuideCommands._typed", "PointTableModel._is_refused", "FieldForm._entry"),
    *("FieldEdit._entered", "FocusCommands._named", "TransformPanelCommands._turning"),
    "WiggleCommands._scrub_before",
    # Where a motion was stopped, what a panel showed that is closed; both begin anew.
    *("LessonPanel._step", "Player._course", "Player._ran_on", "Player._scrub_before", "Player.seconds"),
    *("ViewCommands._before_folding", "ViewCommands._before_presentation"),
    # What was to be done had the work been stopped that has ended; what tries files, made for the first.
    *("FileWork._stopped", "FamilyFiles._trial_task"),
    # The sentence that was put away last; the next one takes its place.
    "OwnFamilyCommands._dismissed",
    # What a panel covered when it was brought up; it is asked for only when that is closed.
    "_covered",
    # How often something has happened.
    *("_document_number", "_target_number"),
    # What belongs to a document that is open no more, by the place where it began.
    *("LessonCommands._visits", "LessonCommands._given"),
}
"""Names of attributes that may differ, some of one class only."""

_PASSING = [(name.rpartition(".")[0], name.rpartition(".")[2]) for name in PASSING]

DRAWN = {"PointInk", "Stamps", "_Batch"}
"""Classes, with those derived from them, of which all that differs is what was drawn last."""

RENDERED_ANEW = {
    *("CommandPalette", "DigitsTable", "NoticeBar", "JobBar", "Legend", "MotionBar", "MotionDialog"),
    *("PlotPane", "PreferencesDialog", "RecoveryBar", "ShortcutSheet", "WeightBars"),
}
"""Widgets that are made when they are first wanted, and filled whenever they are shown."""

USED_LAST = {"moreToolsButton"}
"""Names of widgets that go on showing what was used last."""


class _Kind:
    """How objects of a type are told.

    Attributes
    ----------
    is_opaque
        There is nothing to tell of them: what is the library's.
    is_record
        They never change, though what they refer to may.
    names
        The attributes that all objects of the type have.
    text
        What returns the text of a widget of the type; None where it has none.
    """

    def __init__(self, kind: type) -> None:
        self.is_plain = issubclass(kind, _PLAIN)
        self.is_function = issubclass(kind, _FUNCTIONS)
        self.is_set = issubclass(kind, set | frozenset)
        self.is_dict = issubclass(kind, dict)
        self.is_rendered_anew = kind.__name__ in RENDERED_ANEW
        self.is_action, self.is_widget = issubclass(kind, QAction), issubclass(kind, QWidget)
        self.is_dock, self.is_tabs = issubclass(kind, QDockWidget), issubclass(kind, QTabWidget)
        self.text = next((each.text for each in (QLabel, QAbstractButton) if issubclass(kind, each)), None)
        package = kind.__module__.partition(".")[0]
        is_known = issubclass(kind, (*_PLAIN, *_FUNCTIONS, set, frozenset, dict, list, tuple))
        self.is_ours = not is_known and package == "app"
        self.is_of_tests = not is_known and package not in {*_LIBRARIES, "app"}
        is_drawn = any(base.__name__ in DRAWN for base in kind.__mro__)
        self.is_opaque = is_drawn or not (is_known or self.is_ours or self.is_of_tests)
        is_struct = issubclass(kind, msgspec.Struct)
        config = getattr(kind, "__struct_config__", None)
        self.is_record = is_struct and config.frozen and not config.dict and not self.is_rendered_anew
        names = set(kind.__struct_fields__ if is_struct else ())
        for base in kind.__mro__:
            slots = vars(base).get("__slots__", ())
            names.update((slots,) if isinstance(slots, str) else slots)
        self.name, self.type = kind.__name__, kind
        owners = {"", *(base.__name__ for base in kind.__mro__)}
        self.passing = {name for owner, name in _PASSING if owner in owners}
        self.names = sorted(names - self.passing)
        self._said_of_all: dict[str, object] = {}

    def said_of_all(self, name: str) -> object:
        """Return what the type itself says; asked once, for where it says nothing Qt for Python is slow."""
        if name not in self._said_of_all:
            self._said_of_all[name] = getattr(self.type, name, _ABSENT)
        return self._said_of_all[name]


class _Kinds(dict[type, _Kind]):
    def __missing__(self, kind: type) -> _Kind:
        self[kind] = _Kind(kind)
        return self[kind]


_kinds = _Kinds()


def _kind_of(value: object) -> _Kind:
    return _kinds[type(value)]


class _Record:
    """What is told of a record, found out once: most that a window reaches is how its actions are declared.

    Attributes
    ----------
    told
        What is told of it and of what in it never changes either, with the places.
    others
        What it refers to beside that, with the places.
    """

    def __init__(self, value: object) -> None:
        # Its id is its own as long as it lives.
        self._value = value
        kind = _kind_of(value)
        told: list[tuple[str, object]] = [("", kind.name)]
        self.others: list[tuple[str, object]] = []
        for name in kind.names:
            self._tell(f".{name}", getattr(value, name, None), told)
        self.told = tuple(told)

    def _tell(self, place: str, value: object, told: list[tuple[str, object]]) -> None:
        kind = _kind_of(value)
        if kind.is_plain:
            told.append((place, value))
        elif kind.is_function:
            told.append((place, value.__qualname__))
        elif kind.is_record:
            record = _record_of(value)
            told.append((place, record.told))
            self.others += [(f"{place}{within}", each) for within, each in record.others]
        elif kind.type is tuple:
            told.append((place, len(value)))
            for index, each in enumerate(value):
                self._tell(f"{place}.{index}", each, told)
        elif not kind.is_opaque:
            self.others.append((place, value))


_records: dict[int, _Record] = {}


def forget() -> None:
    """Let go of the records that were told of, and of the windows that these refer to."""
    _records.clear()
    _visits.clear()
    _visits_of_commands.clear()


def _record_of(value: object) -> _Record:
    record = _records.get(id(value))
    if record is None:
        record = _records[id(value)] = _Record(value)
    return record


_Entry = tuple[int, str, object, _Kind]


class _Visit:
    """What was told of an object or a collection, for as long as all that it refers to is the same.

    Attributes
    ----------
    told
        What is told of it and of what never changes in it, by the places.
    sets
        The sets that it refers to, with the places: of these there is only the size to tell.
    others
        What it refers to beside that: the ids of the objects, the places, the objects, and their kinds.
    """

    def __init__(self, place: str, value: object, kind: _Kind) -> None:
        # Its id is its own as long as it lives.
        self.place, self._value = place, value
        self._slots = kind.names if kind.is_ours else ()
        self._own = getattr(value, "__dict__", {}) if kind.is_ours else value
        self._keys = tuple(self._own) if isinstance(self._own, dict) else None
        self._items, self._in_slots = tuple(self._now()), self._now_in_slots()
        self.told: dict[str, object] = {}
        self.sets: list[tuple[str, Collection[object]]] = []
        self.others: list[_Entry] = []

    def _now(self) -> Collection[object]:
        return self._own if self._keys is None else self._own.values()

    def _now_in_slots(self) -> list[object]:
        return [getattr(self._value, name, None) for name in self._slots]

    def holds(self) -> bool:
        """Whether all that the object refers to is the same as then, not only equal."""
        own = self._own
        if self._keys is None:
            is_same = len(own) == len(self._items) and all(map(is_, own, self._items))
        else:
            is_same = tuple(own) == self._keys and all(map(is_, own.values(), self._items))
        return is_same and (not self._slots or all(map(is_, self._now_in_slots(), self._in_slots)))


_visits: dict[int, _Visit] = {}
_visits_of_commands: dict[int, _Visit] = {}


def _look_at(visit: _Visit, place: str, value: object, kind: _Kind) -> None:
    if kind.is_plain:
        visit.told[place] = value
    elif kind.is_function:
        visit.told[place] = value.__qualname__
    elif kind.is_of_tests:
        # In place of something of ours, or of the library's: a clock, for one.
        visit.told[place] = kind.name
    elif kind.is_record:
        record = _record_of(value)
        visit.told[place] = record.told
        for within, each in record.others:
            _look_at(visit, f"{place}{within}", each, _kind_of(each))
    elif kind.type is tuple and not value:
        # One object, wherever it stands.
        visit.told[f"{place}.count"] = 0
    elif kind.is_set:
        visit.sets.append((place, value))
    else:
        visit.others.append((id(value), place, value, kind))


def _look_at_items(visit: _Visit, place: str, value: Collection[object], kind: _Kind) -> None:
    visit.told[f"{place}.count"] = len(value)
    for key, each in value.items() if kind.is_dict else enumerate(value):
        known = _kind_of(each)
        if not known.is_opaque and (not kind.is_dict or isinstance(key, _PLAIN)):
            _look_at(visit, f"{place}.{key}", each, known)


def _look_at_ours(visit: _Visit, place: str, value: object, kind: _Kind) -> None:
    visit.told[f"{place}.type"] = kind.name
    for name in kind.names:
        each = getattr(value, name, None)
        known = _kind_of(each)
        if not known.is_opaque:
            _look_at(visit, f"{place}.{name}", each, known)
    for name, each in getattr(value, "__dict__", {}).items():
        known = _kind_of(each)
        # What the class says of all is not told of each.
        if not known.is_opaque and name not in kind.passing and each is not kind.said_of_all(name):
            _look_at(visit, f"{place}.{name}", each, known)


def _look_at_commands(visit: _Visit, place: str, commands: object, kind: _Kind) -> None:
    """Tell of a set of commands: no name leads to it. Its widgets are told of where they are seen."""
    for name, value in vars(commands).items():
        each = None if _kind_of(value).is_widget else value
        known = _kind_of(each)
        if not known.is_opaque and name not in kind.passing:
            _look_at(visit, f"{place}.{name}", each, known)


class Fingerprint:
    """What can be told of a window: the plain values of all objects of ours that it reaches, and its widgets.

    Attributes
    ----------
    told
        What was found, by where it was found.
    """

    def __init__(self, window: QWidget) -> None:
        self.told: dict[str, object] = {}
        self._window = window
        self._seen: set[int] = set()
        self._walk([(id(window), "window", window, _kind_of(window))])
        for commands in window.commands._sets.values():
            self._tell_commands(commands)
        for each in _visits.keys() - self._seen:
            del _visits[each]
        # Together: to look for children takes long, and hardly longer for all than for some.
        actions = []
        for child in window.findChildren(QObject, _OUR_NAMES):
            kind = _kind_of(child)
            if kind.is_action:
                actions.append(child)
            elif kind.is_widget:
                self._tell_widget(child, kind)
        texts, keys = map(_text, actions), map(_key_text, map(_shortcut, actions))
        told = zip(
            map(_is_checked, actions),
            map(_is_enabled, actions),
            map(_is_visible, actions),
            # The letters that are underlined are given out when a menu opens.
            [text.replace("&", "") for text in texts],
            keys,
            strict=True,
        )
        self.told.update(zip([f"action {name}" for name in map(_object_name, actions)], told, strict=True))

    def _tell_commands(self, commands: object) -> None:
        visit = _visits_of_commands.get(id(commands))
        if visit is None or not visit.holds():
            kind = _kind_of(commands)
            visit = _visits_of_commands[id(commands)] = _Visit(f"commands {kind.name}", commands, kind)
            _look_at_commands(visit, visit.place, commands, kind)
        self._tell(visit)
        self._walk(visit.others[::-1])

    def _tell(self, visit: _Visit) -> None:
        self.told.update(visit.told)
        for place, value in visit.sets:
            self.told[place] = len(value)

    def _tell_widget(self, widget: QWidget, kind: _Kind) -> None:
        name = _object_name(widget)
        if kind.is_dock:
            self.told[f"dock {name}"] = bool(_property(widget, "hasRoom"))
        if kind.is_tabs and (page := _current_index(widget)) > 0:
            # Whoever shows it again sees the page that was seen last.
            self.told[f"page of {name}"] = page
        # What is out of sight is told what to say before it is shown.
        if _is_visible_to(widget, self._window) and name not in USED_LAST:
            text = "" if kind.text is None else kind.text(widget)
            self.told[f"widget {name}"] = _is_widget_enabled(widget), text, _tool_tip(widget)

    def _walk(self, left: list[_Entry]) -> None:
        """Tell of what may change though it stays the same object, from the last of these on."""
        seen = self._seen
        while left:
            own_id, place, value, kind = left.pop()
            if own_id in seen:
                continue
            seen.add(own_id)
            if kind.is_rendered_anew and not _is_visible_to(value, self._window):
                # As if it were not there yet.
                self.told[place] = None
                continue
            visit = _visits.get(own_id)
            if visit is None or visit.place != place or not visit.holds():
                visit = _visits[own_id] = _Visit(place, value, kind)
                (_look_at_ours if kind.is_ours else _look_at_items)(visit, place, value, kind)
            self._tell(visit)
            left += reversed(visit.others)


def named_actions(window: QWidget) -> list[QAction]:
    return window.findChildren(QAction, _OUR_NAMES)


def differences(told: Mapping[str, object], *known: Mapping[str, object]) -> dict[str, object]:
    """Return what is in none of the `known` fingerprints as it is in `told`, by its place."""
    if any(told == each for each in known):
        return {}
    first, *others = known
    places = [place for place, value in told.items() if first.get(place, _ABSENT) != value]
    places += first.keys() - told.keys()
    for each in others:
        places = [place for place in places if told.get(place, _ABSENT) != each.get(place, _ABSENT)]
    return {place: told.get(place, _ABSENT) for place in places}
