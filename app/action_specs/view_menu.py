"""The menu View: zoom, panels and theme."""

from __future__ import annotations

from app.action_specs.spec import ActionSpec

VIEW_MENU = (
    ActionSpec("fitView", "Fit", "View", "F", "fit", "Show the whole curve", alone="Fit View"),
    ActionSpec("zoomIn", "Zoom In", "View", "+, =", "zoom-in", "Zoom in on the canvas"),
    ActionSpec("zoomOut", "Zoom Out", "View", "-", "zoom-out", "Zoom out on the canvas"),
    ActionSpec(
        "toggleGrid",
        "Grid",
        "View",
        "Ctrl+'",
        "grid",
        "Show or hide the grid",
        checkable=True,
        separated=True,
        alone="Show Grid",
    ),
    ActionSpec(
        "toggleSnap",
        "Snap",
        "View",
        "Shift+S",
        "magnet",
        "Snap to grid, points and curves; Ctrl while dragging turns it round",
        checkable=True,
    ),
    ActionSpec(
        "toggleScrub",
        "Scrub Line",
        "View",
        "T",
        "spline",
        "Show a point running along the curve and the weight of every point",
        checkable=True,
    ),
    ActionSpec(
        "toggleBasis",
        "Basis Functions",
        "View",
        "F8",
        "panel-bottom",
        "Show or hide the basis functions",
        checkable=True,
    ),
    ActionSpec(
        "toggleSidePanel",
        "Side Panel",
        "View",
        "F9",
        "panel-right",
        "Show or hide the panels at the side",
        checkable=True,
    ),
    ActionSpec(
        "enlarge",
        "Larger Drawing",
        "View",
        "Ctrl+=, Ctrl++",
        "plus",
        "Enlarge points, lines and type, for a projector",
        separated=True,
    ),
    ActionSpec("shrink", "Smaller Drawing", "View", "Ctrl+-", "", "Make points, lines and type smaller"),
    ActionSpec(
        "usualSize", "Usual Drawing", "View", "Ctrl+0", "", "Points, lines and type as they usually are"
    ),
    ActionSpec(
        "presentation",
        "Presentation",
        "View",
        "F11",
        "presentation",
        "Hide everything but canvas and basis functions",
        checkable=True,
    ),
    ActionSpec(
        "themeSystem",
        "Theme: as the System",
        "View",
        "",
        "",
        "Light or dark, as the system is",
        "theme",
        separated=True,
    ),
    ActionSpec("themeLight", "Theme: Light", "View", "", "", "Light colours", "theme"),
    ActionSpec("themeDark", "Theme: Dark", "View", "", "", "Dark colours", "theme"),
)
