"""State of a window: one value, one owner, one signal; its analysis has an owner of its own."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec
from msgspec.structs import replace
from PySide6.QtCore import QObject, Signal

from ..appearance.theme import ThemeMode
from ..document.transforms import Reference
from ..settings.preferences import Preferences
from ..storage.open_file import FileChange
from ..tools.canvas.select import SELECT
from ..tools.snapping import SnapKind, Snapping
from ..tools.tool import ToolRecord
from ..view_model.analysis.ghost import Ghost
from ..view_model.analysis.overlay import Overlay
from ..view_model.analysis.plot import Plot, PlotData
from ..view_model.analysis.settings import AnalysisSettings
from ..view_model.motion_settings import MotionSettings
from ..view_model.settings import OwnedSetting, SettingValues


class FileState(msgspec.Struct, frozen=True):
    """State of the document's file.

    Attributes
    ----------
    change
        Change of the file since it was last read or written here; None without a file.
    is_read_only
        Whether the file is open elsewhere.
    may_overwrite
        Whether saving was, or would be, refused because the file has other content.
    is_asked
        Whether the user was warned that the document may be edited elsewhere, before taking it over.
    """

    change: FileChange | None = None
    is_read_only: bool = False
    may_overwrite: bool = False
    is_asked: bool = False


class WindowState(msgspec.Struct, frozen=True):
    """State of a window besides its document: visible parts, tool and settings; neither saved nor undone.

    Actions, docks and plots show it and ask `WindowStore` for another one; no widget is asked for its own
    state. A switch is one field here and one action: ``store.change(grid=not store.state.grid)``.

    Attributes
    ----------
    tool
        What a press on the canvas means.
    moves_image
        Whether the mouse has the reference image instead of the points.
    basis, numbered
        Whether the basis functions are visible; whether points have numbers and colours, by which they
        are.
    grid, side_panel, lessons
        Whether the grid, the panels at the side and the lessons are shown.
    rulers, guides_visible
        Whether the axes of the canvas are rulers; whether guides are shown.
    presentation
        Whether everything but canvas and basis functions is hidden.
    scale
        How large points, lines and type are drawn; 1 as usual.
    snap_on, snap_kinds, with_estimates, theme_mode, tool_settings
        As in the preferences.
    transform_box, keep_proportions, handle_columns
        As in the preferences.
    align_to
        Reference for aligning curves.
    analysis
        Overlays, plots, ghosts and laboratory.
    error_plot
        Whether the errors of the laboratory's methods are plotted.
    motion, motion_visible, motion_plays
        Settings of the motion, whether it is visible, and whether it is playing.
    file, compares_with_file
        State of the document's file, and whether its content is shown as a ghost.
    is_working
        Whether something is being read, written or computed beside the window.
    offers_family, runs_family_file
        Whether there is a file of families just written or used, and whether one is running.
    in_flight
        Whether Undo cancels a gesture, or the computation that follows it, before there is a step.
    undoes_discard
        Whether Undo offers the unsaved work again that was just discarded.
    image_problem
        Reason why the reference image is not shown; empty where it is, or without an image.
    """

    tool: ToolRecord = SELECT
    moves_image: bool = False
    grid: bool = True
    basis: bool = True
    numbered: bool = True
    side_panel: bool = True
    lessons: bool = False
    rulers: bool = True
    guides_visible: bool = True
    presentation: bool = False
    scale: float = 1.0
    snap_on: bool = False
    snap_kinds: frozenset[SnapKind] = frozenset(SnapKind)
    transform_box: bool = True
    keep_proportions: bool = False
    handle_columns: bool = False
    align_to: Reference = Reference.EACH_OTHER
    with_estimates: bool = False
    theme_mode: ThemeMode = ThemeMode.SYSTEM
    tool_settings: SettingValues = SettingValues()
    analysis: AnalysisSettings = AnalysisSettings()
    error_plot: bool = False
    motion: MotionSettings = MotionSettings()
    motion_visible: bool = False
    motion_plays: bool = False
    compares_with_file: bool = False
    file: FileState = FileState()
    is_working: bool = False
    offers_family: bool = False
    runs_family_file: bool = False
    in_flight: bool = False
    undoes_discard: bool = False
    image_problem: str = ""

    @property
    def shows_rulers(self) -> bool:
        """Whether rulers are visible: not in a presentation."""
        return self.rulers and not self.presentation

    @property
    def snapping(self) -> Snapping:
        """The settings of snapping."""
        return Snapping(self.snap_on, self.snap_kinds)

    def uses(self, tool: ToolRecord) -> bool:
        """Return whether this tool is in use; none is while the mouse moves the image."""
        return self.tool is tool and not self.moves_image


class WindowStore(QObject):
    """Owner of the state of a window; fields with a preference of the same name are saved there.

    ``store.change(grid=True)`` emits `changed` once with both states, or nothing where they are equal.

    Attributes
    ----------
    state
        The current state.

    Signals
    -------
    changed
        The state was another one before: (before, after).
    """

    changed = Signal(object, object)

    def __init__(self, preferences: Preferences, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._preferences = preferences
        self.state = self._announced = replace(WindowState(), **self._remembered())
        self._is_announcing = False

    def _remembered(self) -> dict[str, object]:
        """Return the fields that have a preference of the same name."""
        names = WindowState.__struct_fields__
        return {
            name: getattr(self._preferences, name) for name in names if hasattr(type(self._preferences), name)
        }

    def change(self, **fields: object) -> None:
        """Change some fields."""
        for name, value in fields.items():
            if hasattr(type(self._preferences), name) and value != getattr(self.state, name):
                setattr(self._preferences, name, value)
        self._take(replace(self.state, **fields))

    def read_preferences(self) -> None:
        """Read the fields that have a preference again."""
        self._take(replace(self.state, **self._remembered()))

    def _take(self, state: WindowState) -> None:
        if state == self.state:
            return
        self.state = state
        if self._is_announcing:
            # Changed by a receiver of the signal: all others get the first change first.
            return
        self._is_announcing = True
        try:
            while self._announced is not self.state:
                before, self._announced = self._announced, self.state
                self.changed.emit(before, self._announced)
        finally:
            self._is_announcing = False


class Analysis(QObject):
    """Settings of overlays, plots and laboratory of one window.

    Signals
    -------
    changed
        The settings are other ones.
    noted
        The notes about overlays have changed.
    ghost_adopted
        A ghost is to replace the curve.
    added
        A plot was added, replaced or removed.

    Attributes
    ----------
    added_plots
        Further plots besides those of the curve, by title.
    notes
        Notes about some overlays: a measured value, or the reason why nothing is drawn.
    problem
        Why there is nothing to analyse; empty where there is a curve.
    """

    changed = Signal()
    noted = Signal()
    ghost_adopted = Signal(object)
    added = Signal()

    def __init__(self, store: WindowStore, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._store = store
        store.changed.connect(self._follow_state)
        self.added_plots: dict[str, PlotData] = {}
        self.notes: Mapping[Overlay, str] = {}
        self.problem = ""

    @property
    def settings(self) -> AnalysisSettings:
        """The settings, a part of the window's state."""
        return self._store.state.analysis

    def _follow_state(self, before: WindowState, after: WindowState) -> None:
        if after.analysis != before.analysis:
            self.changed.emit()

    def change(self, **fields: object) -> None:
        """Change some settings."""
        self._store.change(analysis=replace(self.settings, **fields))

    def set_value(self, setting: OwnedSetting[float], value: float) -> None:
        """Change a setting of an overlay."""
        self._store.change(analysis=self.settings.with_value(setting, value))

    def reset(self) -> None:
        """Reset all settings to their defaults."""
        self.change(**msgspec.structs.asdict(AnalysisSettings()))

    def show(self, overlay: Overlay, visible: bool) -> None:
        """Show or hide an overlay."""
        others = self.settings.overlays - {overlay}
        self.change(overlays=others | {overlay} if visible else others)

    def show_plot(self, plot: Plot, visible: bool) -> None:
        """Show or hide a plot over t."""
        others = self.settings.plots - {plot}
        self.change(plots=others | {plot} if visible else others)

    def add_plot(self, plot: PlotData) -> None:
        """Add a plot over the visible part of t, in place of one of the same title."""
        self.added_plots[plot.title] = plot
        self.added.emit()

    def remove_plot(self, title: str) -> None:
        """Remove the added plot with this title, if there is one."""
        if self.added_plots.pop(title, None) is not None:
            self.added.emit()

    def show_ghost(self, ghost: Ghost, visible: bool) -> None:
        """Show or hide a variant of the curve."""
        others = self.settings.ghosts - {ghost}
        self.change(ghosts=others | {ghost} if visible else others)

    def note(self, notes: Mapping[Overlay, str], problem: str = "") -> None:
        """Set the notes about overlays."""
        if (notes, problem) != (self.notes, self.problem):
            self.notes, self.problem = notes, problem
            self.noted.emit()
