"""Curvebench, the editor: what runs in the window.

The layers, top to bottom; a module imports only from its own layer and those above it:

- ``families``: the curve families that there are, in a registry. No Qt.
- ``document``: immutable values and edits. No Qt, no arrays inside the values.
- ``storage``: documents on disk: format, migration, atomic write, locks, snapshots. No Qt.
- ``tasks``: work beside the window's thread: progress, cancelling, debouncing. No Qt in ``progress``.
- ``view_model``: a document's curve turned into arrays to draw. No Qt; calls ``curvecore``.
- ``tools``: press, move and release turned into edits. No Qt.
- ``exchange``: files in and out. Qt only in ``image`` and ``motion_frames``.
- ``overrides``: exceptions end in the method that Qt called.
- ``resources``, ``examples``, ``lessons``: what comes with the program.
- ``session``: the one mutable owner of the current document, its history and the selection.
- ``theme``, ``colours``, ``icons``: how it looks.  ``labels``: words of others as they are written.
- ``settings``: what is remembered between starts, and the ini file that holds it.
- ``keymap``: which keys do what.  ``mnemonics``: the letters of menus.
- ``window_state``: the window's state as a value.  ``analysis``: what is shown over the curve, a part of it.
- ``plotting``: what canvas and basis panel share: a pixel map, fast drawing, pan and zoom.
- ``canvas``, ``panels``: draw a value and report what the person did. They never call each other.
- ``controllers``: what the person did in a panel becomes a change of the document.
- ``central_area``: the plots and what lies over them.  ``clipboard_watch``: what is on the clipboard.
- ``actions``, ``docks``, ``file_commands``, ``commands``, ``features``: what can be done, and what it does.
- ``toolbar``, ``menus``, ``window_layout``, ``main_window``: build, dock, connect.
- ``diagnostics``: the log, slow frames, reports of crashes.
- ``cli``: the command line, the editor's start, and what surrounds its windows until the end.
- ``testing``: a driver for pytest-qt.
"""

import lazy_loader as lazy

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
