"""What the actions do: each a few lines that turn a trigger into an edit or a change of view.

- ``connect``: makes the command sets of a window and binds the actions that they declare.
  ``context``: what command sets act on.
- ``document_commands``: new, open, save and quit.  ``work_commands``: stops what is read or written.
- ``edit_commands``, ``curve_commands``: history, points, family and parameters; whole curves.
- ``curve_clipboard``: whole curves on the clipboard.
- ``selection_commands``, ``tangent_commands``: transforms of the selected points; their tangents.
- ``clipboard_commands``: points on the clipboard.  ``context_menus``: what the right button opens.
- ``exchange_commands``: import and export.  ``import_series``: of several files.
  ``file_work``: how what takes long is shown and stopped.
- ``plot_commands``: what is plotted over t.
- ``teaching_commands``: warnings that teach.
- ``snap_commands``: snapping, the grid's spacing and the unit.
- ``view_commands``, ``dock_room``: tools, zoom, panels, presentation, theme; room for a dock.
- ``focus_commands``: the keyboard's way from panel to panel.
- ``rail_commands``: the menu of the t-rail.
- ``tool_commands``: palette, preferences, shortcuts.
- ``messages``, ``fresh_hints``: the line on the canvas; the hint in the status line.
- ``given``, ``drops``: files by what is done with them; those dragged over the window.
"""
