"""Appearance of the program: palettes, colours and icons, light and dark.

- ``theme``: the themes, and widgets that follow them.  ``colours``: colours of points and curves.
  ``icons``: icons in the colours of a theme.
"""
