"""The panels around the canvas. They draw a value and report what the person did.

Beside the canvas:

- ``basis_pane``: the basis functions over t with a header.  ``basis_scene``: its layers.
  ``basis_panel``: the gestures on it.  ``basis_hits``: what lies under the pointer.  ``tick_edit``: a t typed
  at its tick.  ``basis_layers``, ``function_lines``, ``crest_names``: functions, t-rail, scrub line, painted.
- ``plot_panel``, ``plot_pane``, ``plot_canvas``, ``plot_layers``, ``value_scale``: plots over t.
- ``parametrization_bar``: the rule for the t_i and its α.

In docks:

- ``late_dock``: a dock whose content is built when it is first shown.

Words and dialogs:

- ``status_line``, ``job_bar``, ``teaching_badge``: at the foot.  ``message_bar``: over
  the canvas.
- ``command_palette``, ``fuzzy``: type what you want.  ``shortcut_editor``: keys.
- ``preferences_dialog``, ``crash_dialog``.  ``export_dialog``, ``export_form``,
  ``export_fields``: export.
- ``import_drawing_dialog``, ``import_table_dialog``, ``table_preview``, ``role_header``,
  ``group_tree``, ``import_foot``, ``turn``: import.

Small parts:

- ``action_switch``: buttons that show an action.
- ``field_edit``, ``live_slider``, ``setting_slider``, ``elided_label``, ``thumbnail``,
  ``form_parts``, ``tool_buttons``, ``fitting``, ``told_spin``, ``work_dialog``, ``choice_style``.
- ``number_text``: numbers as panels write them.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
