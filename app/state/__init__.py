"""State of a window beside its document.

- ``window_state``: `WindowState` with its store, and the settings of overlays, plots and laboratory.

To add what a window can be switched to: a field of `WindowState`, and `@switch("field", …)`
(``app/actions``) for the action that turns it on and off. A preference of the same name remembers it
between starts. Other handlers call `store.change(field=…)`; whoever shows it connects to
`store.changed(before, after)`.
"""
