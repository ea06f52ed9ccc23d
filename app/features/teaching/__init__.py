"""Warnings that teach, in a badge of the status line.

- ``commands``: when one is shown.  ``teaching_badge``: the badge.
"""
