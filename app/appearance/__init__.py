"""Appearance of the program: palettes, colours and icons, light and dark.

To add an icon: put an SVG that draws in `currentColor` into ``resources/icons``; its name is the icon's.

- ``theme``: the themes, and widgets that follow them.  ``colours``: colours of points and curves.
  ``icons``: icons in the colours of a theme.
"""
