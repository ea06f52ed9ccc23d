"""View: tools, zoom, panels, presentation and theme.

- ``commands``: the actions.
"""
