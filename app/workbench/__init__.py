"""Parts of a window that features act on.

- ``context``: `WindowContext`, the hooks by which command sets take part in the window, context menus.
- ``central_area``: the canvas and the panes below it.  ``message_bar``: bars over the canvas.
- ``docks``: panels at the sides.  ``status_line``: hints, messages and numbers.
- ``document_files``: opening and saving, with their questions.  ``file_work``: files read and written beside
  the window.  ``disk_watch``: notices that a file may have changed.
- ``highlight``: the curves or points that Copy, Cut, Duplicate and Delete act on, and their removal.
  ``clipboard``: its content.
- ``form_edits``: changes of the document by a form and its sliders.
"""
