"""Appearance of the program: palettes, colours and icons, light and dark.

- ``theme``: the themes.  ``colours``: those of points and curves.  ``icons``: drawn in those of a theme.
- ``themed``: widgets that follow the theme.  ``swatches``: small discs in a colour.
"""
