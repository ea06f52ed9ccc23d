"""Recovery of unsaved work.

- ``autosave``: a snapshot of what is not saved yet.  ``set_aside``: of what was left for a lesson.
- ``commands``: offers snapshots of ended processes, and brings them back.
- ``bar``, ``offers``, ``thumbnail``: the panel that offers them, its words and pictures.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
