"""Curvebench, the editor: what runs in the window.

The layers, top to bottom; a module imports only from its own layer and those above it:

- ``document``: immutable values, edits, the file format. No Qt, no arrays inside the values.
- ``view_model``: a document's curve turned into arrays to draw. No Qt; calls ``curvecore``.
- ``gestures``: press, move and release turned into edits. No Qt.
- ``exchange``: files in and out. Qt only in ``image``.
- ``resources``, ``examples``, ``lessons``: what comes with the program.
- ``session``: the one mutable owner of the current document, its history and the selection.
- ``analysis``, ``settle``: what is shown over the curve; what is computed beside the window.
- ``theme``, ``colours``, ``icons``, ``preferences``: how it looks; what is remembered between starts.
- ``keymap``: which keys do what.
- ``plot``: what canvas and basis panel share: a pixel map, fast drawing, pan and zoom.
- ``canvas``, ``panels``: draw a value and report what the person did. They never call each other.
- ``action_specs``, ``actions``, ``file_commands``, ``commands``: what can be done, and what it does.
- ``toolbar``, ``main_window``: build, dock, connect.
- ``cli``: the command line.  ``testing``: a driver for pytest-qt.
"""

__version__ = "0.1.0"
