"""Curvebench, the editor: what runs in the window.

The layers, top to bottom; a module imports only from its own layer and those above it:

- ``families``: the curve families that there are: the registry that all else reads. No Qt.
- ``document``: immutable values and edits. No Qt, no arrays inside the values.
- ``storage``: documents on disk: format, migration, atomic write, locks, snapshots. No Qt.
- ``tasks``: work beside the window's thread: progress, cancelling, debouncing. No Qt in ``progress``.
- ``view_model``: a document's curve turned into arrays to draw. No Qt; calls ``curvecore``.
- ``tools``: press, move and release turned into edits. No Qt.
- ``exchange``: files in and out. Qt only in ``image`` and ``motion_frames``.
- ``overrides``: exceptions end in the method that Qt called.
- ``resources``, ``examples``, ``lessons``: what comes with the program.
- ``undo_step``: a step of the history.
- ``session``: the one mutable owner of the current document, its history and the selection.
- ``analysis``: what is shown over the curve.
- ``autosave``: keeps a snapshot of what is not saved yet.  ``set_aside``: of what was left for a lesson.
- ``player``: a motion, and the clock that drives it.
- ``theme``, ``colours``, ``icons``: how it looks.  ``labels``: words of others as they are written.
- ``preferences``: what is remembered between starts.  ``settings``, ``settings_file``: the kinds of settings;
  their ini file.
- ``keymap``: which keys do what.  ``mnemonics``: the letters of menus.
- ``disk_watch``: notices when a file may have changed.
- ``plotting``: what canvas and basis panel share: a pixel map, fast drawing, pan and zoom.
- ``canvas``, ``panels``: draw a value and report what the person did. They never call each other.
- ``controllers``: what the person did in a panel becomes a change of the document.
- ``action_specs``, ``actions``, ``file_commands``, ``commands``: what can be done, and what it does.
- ``toolbar``, ``menus``, ``docks``, ``window_layout``, ``main_window``: build, dock, connect.
- ``start``: windows on the screen, soon.  ``display``: whether there is a screen for them.
- ``crash_report``, ``crash_handler``, ``lifecycle``: what surrounds the windows from start to end.
- ``cli``, ``cli_commands``, ``cli_options``, ``cli_refusals``: the command line.
- ``testing``: a driver for pytest-qt.
"""

__version__ = "0.1.0"
