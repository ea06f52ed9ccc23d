"""Parts of a window that features act on.

- ``context``: the parts, and the protocols of command sets.
- ``central_area``: the plots and what lies over them.  ``central_pane``: one below the canvas.
  ``message_bar``: the line on the canvas.  ``notice_bar``: one about a file, with several buttons.
- ``docks``: panels at the sides.  ``dock``: one of them; many are built when they are first shown.
  ``dock_room``: room for one that needs more than its share.  ``dock_title``: its buttons.
- ``document_files``: opening and saving, with their questions; what new ones are.
  ``file_names``: what they are called.
  ``file_work``: files beside the window.  ``disk_watch``: notices that a file may have changed.
- ``status_line``: hints and messages; ``readouts``: numbers beside them.  ``clipboard``: what is put there.
- ``highlight``: what is highlighted, by selection and focus, and its removal.
- ``bar_menu``: context menus.
- ``form_edits``: changes of the document by a form, live by its sliders.
"""
