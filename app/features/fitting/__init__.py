"""Curves of few points near many: how near the pencil comes, and fewer points for a curve.

- ``commands``: the actions, and what they keep in step.
"""
