"""Warnings that teach, in a badge of the status line.

- ``commands``: the badge, and the rules that show and hide it.
"""
