"""View: tools, zoom, panels, presentation and theme.

- ``commands``: tools, panels, presentation and theme.  ``zoom_commands``: zoom.
- ``more_tools_button``: the button of further tools in the toolbar.
- ``zoom_field``: its field in the status line, and zoom in per cent.  ``past_views``: the way back.
"""
