"""View: tools, zoom, panels, presentation and theme.

- ``commands``: tools, panels, presentation and theme.  ``zoom``: zoom and the views to go back to.
- ``more_tools_button``: the button of the toolbar for further tools.
"""
