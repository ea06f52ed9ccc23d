"""Boxes around points and curves, and what is moved or stretched by them.

- ``bounds``: the box of points or curves, exact ones of many at once.
- ``stretch``: what fills another box, or is given a width or a height.
- ``alignment``: curves aligned by their boxes.
- ``pivot``: the place that transforms are about, and what they did.
"""
