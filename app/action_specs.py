"""The one registry of actions: menus, toolbar, palette, shortcuts and tooltips are made from it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ActionSpec:
    """What an action is called, how it is reached and where it stands.

    Attributes
    ----------
    name
        The action's objectName.
    text
        Menu text, without mnemonic.
    menu
        The menu it stands in.
    shortcut
        One or more key sequences, comma separated; empty for none.
    icon
        A file of resources/icons, without suffix; empty for none.
    tip
        What it does, for tooltip and status line; the text itself where empty.
    group
        Name of the exclusive group it belongs to; makes it checkable.
    checkable
        Whether it is a switch of its own.
    separated
        Whether a separator stands before it in its menu.
    submenu
        The submenu of `menu` it stands in; empty for the menu itself.
    """

    name: str
    text: str
    menu: str
    shortcut: str = ""
    icon: str = ""
    tip: str = ""
    group: str = ""
    checkable: bool = False
    separated: bool = False
    submenu: str = ""


MENUS = ("File", "Edit", "Curve", "Analysis", "View", "Help")

SPECS = (
    ActionSpec("newDocument", "New", "File", "Ctrl+N", "new", "Start an empty document"),
    ActionSpec("openDocument", "Open…", "File", "Ctrl+O", "open", "Open a document"),
    ActionSpec("saveDocument", "Save", "File", "Ctrl+S", "save", "Save the document", separated=True),
    ActionSpec(
        "saveDocumentAs",
        "Save As…",
        "File",
        "Ctrl+Shift+S",
        "save-as",
        "Save the document under another name",
    ),
    ActionSpec(
        "exportPicture", "Export…", "File", "Ctrl+E", "export", "Export a picture, splines, code or numbers"
    ),
    ActionSpec(
        "addImage",
        "Reference Image…",
        "File",
        "",
        "image",
        "Put a PNG or JPEG picture behind the curves, to trace it",
        separated=True,
    ),
    ActionSpec(
        "moveImage",
        "Move Image",
        "File",
        "",
        "move",
        "Drag the reference image, and scale it by its corners; points are out of reach meanwhile",
        checkable=True,
    ),
    ActionSpec("findImage", "Find Image…", "File", "", "", "Say where the file of the reference image is"),
    ActionSpec("removeImage", "Remove Image", "File", "", "", "Take the reference image out of the document"),
    ActionSpec("quit", "Quit", "File", "Ctrl+Q", "quit", "Close the window", separated=True),
    ActionSpec("undo", "Undo", "Edit", "Ctrl+Z", "undo", "Take the last step back"),
    ActionSpec("redo", "Redo", "Edit", "Ctrl+Shift+Z, Ctrl+Y", "redo", "Do the step again"),
    ActionSpec(
        "selectTool",
        "Select",
        "Edit",
        "V",
        "select",
        "Select and drag points and handles",
        "tool",
        separated=True,
    ),
    ActionSpec(
        "addTool", "Add Points", "Edit", "P", "add", "Click to add points; drag to set a velocity", "tool"
    ),
    ActionSpec(
        "measureTool", "Measure", "Edit", "M", "measure", "Drag to measure a distance and an angle", "tool"
    ),
    ActionSpec(
        "selectAll", "Select All", "Edit", "Ctrl+A", "select-all", "Select all points", separated=True
    ),
    ActionSpec(
        "moveSelection",
        "Move",
        "Edit",
        "G",
        "move",
        "Move the selected points with the pointer; type the amount",
        submenu="Transform",
    ),
    ActionSpec(
        "scaleSelection",
        "Scale",
        "Edit",
        "S",
        "scale",
        "Scale the selected points with the pointer; type the factor",
        submenu="Transform",
    ),
    ActionSpec(
        "rotateSelection",
        "Rotate",
        "Edit",
        "R",
        "rotate",
        "Rotate the selected points with the pointer; type the angle",
        submenu="Transform",
    ),
    ActionSpec(
        "toggleTransformBox",
        "Box with Grips",
        "Edit",
        "",
        "transform-box",
        "Show a box with grips around two or more selected points",
        checkable=True,
        separated=True,
        submenu="Transform",
    ),
    ActionSpec(
        "alignLeft",
        "Left",
        "Edit",
        "",
        "align-left",
        "Put the selected points below the leftmost one",
        submenu="Align",
    ),
    ActionSpec(
        "alignCentre",
        "Centre",
        "Edit",
        "",
        "align-centre",
        "Put the selected points on one vertical, halfway",
        submenu="Align",
    ),
    ActionSpec(
        "alignRight",
        "Right",
        "Edit",
        "",
        "align-right",
        "Put the selected points below the rightmost one",
        submenu="Align",
    ),
    ActionSpec(
        "alignTop",
        "Top",
        "Edit",
        "",
        "align-top",
        "Put the selected points level with the highest one",
        separated=True,
        submenu="Align",
    ),
    ActionSpec(
        "alignMiddle",
        "Middle",
        "Edit",
        "",
        "align-middle",
        "Put the selected points on one horizontal, halfway",
        submenu="Align",
    ),
    ActionSpec(
        "alignBottom",
        "Bottom",
        "Edit",
        "",
        "align-bottom",
        "Put the selected points level with the lowest one",
        submenu="Align",
    ),
    ActionSpec(
        "distributeHorizontally",
        "Distribute Horizontally",
        "Edit",
        "",
        "distribute-horizontally",
        "Space the selected points evenly from left to right",
        separated=True,
        submenu="Align",
    ),
    ActionSpec(
        "distributeVertically",
        "Distribute Vertically",
        "Edit",
        "",
        "distribute-vertically",
        "Space the selected points evenly from bottom to top",
        submenu="Align",
    ),
    ActionSpec("deleteSelection", "Delete", "Edit", "Del, Backspace", "delete", "Delete the selected points"),
    ActionSpec(
        "cutPoints",
        "Cut",
        "Edit",
        "Ctrl+X",
        "cut",
        "Copy the selected points and delete them",
        separated=True,
    ),
    ActionSpec(
        "copyPoints", "Copy", "Edit", "Ctrl+C", "copy", "Copy the selected points with their derivatives"
    ),
    ActionSpec(
        "pastePoints",
        "Paste",
        "Edit",
        "Ctrl+V",
        "paste",
        "Append the points on the clipboard: two columns x y, or three t x y",
    ),
    ActionSpec(
        "pasteAsCurve",
        "Paste as New Curve",
        "Edit",
        "Ctrl+Shift+V",
        "",
        "Make a curve of the points on the clipboard",
    ),
    ActionSpec(
        "copyDerivatives",
        "Copy Derivatives",
        "Edit",
        "Ctrl+Alt+C",
        "",
        "Copy the velocity and the acceleration of the selected point",
    ),
    ActionSpec(
        "pasteDerivatives",
        "Paste Derivatives",
        "Edit",
        "Ctrl+Alt+V",
        "",
        "Give the selected points the velocity and the acceleration that were copied",
    ),
    ActionSpec(
        "commandPalette",
        "Command Palette…",
        "Edit",
        "Ctrl+Shift+P",
        "search",
        "Find anything that can be done, by a few letters of its name",
        separated=True,
    ),
    ActionSpec("editShortcuts", "Keyboard Shortcuts…", "Edit", "", "keyboard", "Choose which keys do what"),
    ActionSpec(
        "preferences", "Preferences…", "Edit", "Ctrl+,", "settings", "Theme, unit, grid, snapping and keys"
    ),
    ActionSpec(
        "familyLagrange", "Lagrange", "Curve", "1", "lagrange", "One polynomial through all points", "family"
    ),
    ActionSpec(
        "familyHermite", "Hermite", "Curve", "2", "hermite", "Cubic pieces with given velocities", "family"
    ),
    ActionSpec(
        "familyQuinticHermite",
        "Quintic Hermite",
        "Curve",
        "3",
        "quintic",
        "Quintic pieces with given velocities and accelerations",
        "family",
    ),
    ActionSpec(
        "freezeParameters",
        "Freeze Parameters",
        "Curve",
        "",
        "lock",
        "Keep the parameters as they are: make them manual",
        separated=True,
    ),
    ActionSpec(
        "typeParameter", "Type t…", "Curve", "", "", "Type the parameter of the selected point at its tick"
    ),
    ActionSpec(
        "startUniform", "Manual, from Uniform", "Curve", "", "", "Make the parameters manual, evenly spaced"
    ),
    ActionSpec(
        "startChordLength",
        "Manual, from Chord Length",
        "Curve",
        "",
        "",
        "Make the parameters manual, spaced as the points are",
    ),
    ActionSpec(
        "startCentripetal",
        "Manual, from Centripetal",
        "Curve",
        "",
        "",
        "Make the parameters manual, spaced by the square roots of the distances",
    ),
    ActionSpec(
        "startChebyshev",
        "Manual, from Chebyshev",
        "Curve",
        "",
        "",
        "Make the parameters manual, at Chebyshev points",
    ),
    ActionSpec(
        "resetVelocities",
        "Reset Derivatives to Estimated",
        "Curve",
        "",
        "reset",
        "Let the rules estimate the velocities and accelerations of the selected points again",
    ),
    ActionSpec(
        "insertPoint",
        "Insert Point at the Scrub Line",
        "Curve",
        "I",
        "add",
        "Insert a point on the curve; under manual parameters its shape stays",
    ),
    ActionSpec(
        "keepShape",
        "Freeze and Keep the Shape",
        "Curve",
        "",
        "lock",
        "Take the insertion back, freeze the parameters and insert the point again: the shape stays",
    ),
    ActionSpec(
        "newCurve",
        "New Curve",
        "Curve",
        "Ctrl+Shift+N",
        "plus",
        "Add a curve to the document",
        separated=True,
    ),
    ActionSpec(
        "duplicateCurve",
        "Duplicate Curve",
        "Curve",
        "Ctrl+D",
        "duplicate",
        "Add a copy of the curve, in the same place",
    ),
    ActionSpec("deleteCurve", "Delete Curve", "Curve", "Shift+Del", "delete", "Delete the curve"),
    ActionSpec(
        "joinCurve",
        "Join End to Start",
        "Curve",
        "Ctrl+J",
        "join",
        "Join the end of the curve to the nearest start of another",
        separated=True,
    ),
    ActionSpec(
        "splitCurve",
        "Split",
        "Curve",
        "Ctrl+K",
        "split",
        "Split the curve at the selected point, or at the scrub line",
    ),
    ActionSpec(
        "reverseCurve", "Reverse", "Curve", "Ctrl+R", "reverse", "Run through the curve the other way"
    ),
    ActionSpec(
        "closeCurve",
        "Closed",
        "Curve",
        "C",
        "closed",
        "Let the curve return smoothly to its first point, or open it",
        checkable=True,
    ),
    ActionSpec(
        "curveVisible",
        "Visible",
        "Curve",
        "Ctrl+H",
        "eye",
        "Show or hide the curve",
        checkable=True,
        separated=True,
    ),
    ActionSpec(
        "curveLocked", "Locked", "Curve", "Ctrl+L", "lock", "Keep the curve safe from changes", checkable=True
    ),
    ActionSpec("curveColour", "Colour…", "Curve", "", "palette", "Choose the colour of the curve"),
    ActionSpec("renameCurve", "Rename…", "Curve", "", "", "Give the curve another name"),
    ActionSpec(
        "raiseCurve",
        "Move Up in the List",
        "Curve",
        "Alt+Up",
        "move-up",
        "Draw the curve earlier, behind others",
    ),
    ActionSpec(
        "lowerCurve",
        "Move Down in the List",
        "Curve",
        "Alt+Down",
        "move-down",
        "Draw the curve later, in front of others",
    ),
    ActionSpec("nextCurve", "Next Curve", "Curve", "Ctrl+PgDown", "", "Edit the next curve", separated=True),
    ActionSpec("previousCurve", "Previous Curve", "Curve", "Ctrl+PgUp", "", "Edit the previous curve"),
    ActionSpec(
        "tangentSmooth",
        "Smooth",
        "Tangent",
        "Alt+1",
        "spline",
        "One velocity on both sides of the selected points",
        checkable=True,
    ),
    ActionSpec(
        "tangentCorner",
        "Corner",
        "Tangent",
        "Alt+2",
        "corner",
        "A velocity of its own on either side of the selected points",
        checkable=True,
    ),
    ActionSpec(
        "tangentEstimated",
        "Estimated",
        "Tangent",
        "Alt+3",
        "reset",
        "Let the rules estimate the tangents of the selected points",
        checkable=True,
    ),
    ActionSpec(
        "pullVelocity",
        "Pull Out Velocity",
        "Tangent",
        "",
        "",
        "Give the selected points velocities of their own, with handles long enough to drag",
        separated=True,
    ),
    ActionSpec(
        "overlayComb",
        "Curvature Comb",
        "Analysis",
        "Ctrl+Alt+1",
        "comb",
        "Draw how the curve bends, at right angles to it",
        checkable=True,
    ),
    ActionSpec("fitView", "Fit", "View", "F", "fit", "Show the whole curve"),
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
    ActionSpec(
        "toggleLessons",
        "Lessons",
        "Help",
        "F2",
        "lessons",
        "Learn why a curve goes where it goes, in ten lessons",
        checkable=True,
    ),
    ActionSpec("showShortcuts", "Keys and Mouse", "Help", "F1", "help", "Show what keys and mouse do"),
    ActionSpec("about", "About Curvebench", "Help", "", "", "Version and licence"),
)
