"""Two curves of one, one of several, and points and curves from elsewhere.

- ``splitting``, ``joining``: two curves of one, one of several.  ``cutting_out``: segments deleted.
- ``pasting``: points carried from one curve to another.  ``arrivals``: curves from elsewhere.
"""
