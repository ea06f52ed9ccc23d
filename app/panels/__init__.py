"""The panels around the canvas. They draw a value and report what the person did.

- ``basis_pane``, ``basis_panel``, ``basis_layers``: the basis functions over t, the t-rail, the scrub line.
- ``point_table``: the numbers.  ``curve_settings``: interval and tangent rules.
- ``history``: undo, as a list.  ``parametrization_bar``: the rule for the t_i and its α.
- ``motion_bar``, ``motion_dialog``: the controls of a motion, and how it is exported.
- ``message_bar``, ``status_line``, ``shortcut_sheet``: words.
"""
