"""Mouse and keys turned into edits. No Qt: a tool is tested with plain `Pointer` records.

To add a tool: write a file in ``canvas`` with a class of `Tool` and a `ToolRecord`, no more. `Tool.press`
returns a `Gesture`: what happens until the release. One that changes the document is a `Drag`: it says what
the document is with the pointer at a position (`document_at`), and the name of the undo step (`undo_text`).
The docstring of ``tool`` has an example; copy ``canvas/measure`` for a gesture, ``drag_points`` for a drag.
In ``tests/gui``, ``test_tools.py`` adds a tool; it and ``test_toolbar.py``, ``test_menus.py``,
``test_interrupted_gestures.py``, ``test_random_gestures.py`` and ``test_manual.py`` try those that there are.

In reading order:

- ``pointer``: position, modifier keys, what lies under them, what a press would do in words.
- ``tool``: `ToolEvent`, `Gesture`, `Drag`, `Tool`, and the registry of those in ``canvas``.
- ``drag_points``: the drag of points, from the press to the undo step.
- ``toolbox``: the tools of one plot, the gesture in flight.
- ``drag_handles``, ``bend``, ``select_curves``, ``transform``, ``guides``, ``add_points``, ``parameters``,
  ``reference_image``: the other gestures, each in one file from the press to the undo step.
- ``canvas``: the tools that a person chooses.
- ``nudge``: arrow keys and Tab.  ``typed_amount``: a number, or two, typed during a drag.
- ``snapping``: what a point snaps to.
- ``box``: the box around the selection, with grips and pivot.
- ``marks``: what is drawn over the plot.
- ``editing_session``: the session as tools see it.  ``background``: work that takes longer than a moment.
"""
