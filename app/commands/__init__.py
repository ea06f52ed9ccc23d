"""What the actions do: each a few lines that turn a trigger into an edit or a change of view.

- ``parts``: the parts of a window that commands act on, and what a set of commands is.
- ``edit_commands``: history, points, family and parameters.
- ``selection_commands``: move, scale, rotate, align and distribute the selected points.
- ``overlay_commands``: what is drawn over the curve to show why it goes where it goes.
- ``motion_commands``, ``motion_stage``, ``motion_export``: a dot that runs along the curve; films of it.
- ``snap_commands``: snapping, the grid's spacing and the unit, as the preferences have them.
- ``view_commands``: tools, zoom, panels, presentation, theme.
- ``rail_commands``: the menu of the t-rail.
- ``image_commands``: the picture to trace.
- ``tool_commands``: command palette, preferences, shortcuts.
- ``error_plot``: the errors of the laboratory's methods over t.
- ``help_commands``: keys and mouse, about.
- ``lesson_commands``: lessons, their documents and goals.
- ``messages``: the line on the canvas.
- ``connect``: connects the actions of a window to all of them.
"""
