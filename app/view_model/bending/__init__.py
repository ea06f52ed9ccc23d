"""A curve pulled somewhere: the least change of its data.

- ``bend``: the curve pulled somewhere.  ``hold``: the data that give way.  ``bend_together``: a pull divided.
"""
