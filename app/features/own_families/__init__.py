"""Families from a file of Python that the person names, run now and whenever it is saved.

- ``commands``: the actions, and the line under the canvas that tells what became of a file.
- ``files``: the files in use, of all windows together: watched, tried beside the window, then taken over.
  ``bar``: where it is told.  ``trial``: the process that runs one first.  ``template``: one to begin with.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
