"""Curvebench, the editor: everything around the mathematics of `curvecore`.

The layers, top to bottom; a module imports only from its own layer and those above it:

- ``families``: the curve families that there are, in a registry. No Qt.
- ``document``: immutable values and edits. No Qt, no arrays inside the values.
- ``tasks``: work beside the window's thread: progress, cancelling, debouncing. No Qt in ``progress``.
- ``view_model``: a document's curve turned into arrays to draw. No Qt; calls ``curvecore``.
- ``storage``: documents on disk: format, migration, atomic write, locks, snapshots. No Qt.
- ``tools``: press, move and release turned into edits. No Qt.
- ``qt``: exceptions end in the method that Qt called; words of others as they are written; styles as pens.
- ``exchange``: files in and out. Qt only in ``drawing``, where it paints.
- ``session``: the one mutable owner of the current document, its history and the selection.
- ``appearance``: themes, colours, icons.
- ``settings``: what is remembered between starts, and the ini file that holds it.
- ``state``: the window's state as a value.
- ``plotting``: what canvas and basis panel share: a pixel map, fast drawing, pan and zoom.
- ``widgets``: such as know nothing of curves.
- ``canvas``: draws a value and reports what the person did.
- ``actions``: how they are declared, and their keys.
- ``workbench``: the parts of a window that features act on.
- ``features``: what can be done, one package for each capability.
- ``window``: builds, docks and connects; palette, preferences and shortcuts.
- ``diagnostics``: the log, slow frames, reports of crashes.
- ``cli``: the command line, the editor's start, and what surrounds its windows until the end.
- ``testing``: a driver for pytest-qt.

The files in ``resources`` ship with it: icons, examples, lessons (``features/lessons``) and the manual
(``features/help``).
"""

from curvecore import __version__ as __version__
