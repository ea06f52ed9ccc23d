"""A dot that runs along a curve.

- ``motion``, ``motion_settings``: where it is, how fast, and how it shall run.
- ``motion_picture``: its picture.
"""
