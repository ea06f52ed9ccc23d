"""State of a window beside its document.

- ``window_state``: `WindowState` with its store, and the settings of overlays, plots and laboratory.

To add a switch of the window: a field of `WindowState`, and `@switch("field", …)` (``app/actions``) for the
action that turns it on and off. A preference of the same name saves it between starts. Other handlers call
`store.change(field=…)`; parts that show it connect to `store.changed(before, after)`.
"""
