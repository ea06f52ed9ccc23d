"""Families from a file of Python that the person names, run now and whenever it is saved.

- ``commands``: the actions, and the bar under the canvas that reports on a file.
- ``files``: the files in use, of all windows together: watched, tried in another process, then run here.
- ``trial``: the process that tries a file first.  ``template``: a file to begin with.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
