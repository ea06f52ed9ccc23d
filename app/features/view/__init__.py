"""View: tools, zoom, panels, presentation and theme.

- ``commands``: tools and the button of further ones, panels, presentation and theme.
- ``zoom``: zoom and the previous views.
"""
