"""The window's state: one value, one owner, one signal.

- ``window_state``: the value and its store.  ``analysis``: what is shown over the curve, a part of it.
"""
