"""SVG files with the changes of a document in them, and everything else as it was.

- ``rewriting``: the whole.
- ``source``: the file as a tree that is written back to the byte.
- ``found``: its shapes, and those that the document wants.  ``matching``: which are which.
- ``frames``: texts and pictures written new.  ``letters``: texts that say something else in their elements.
  ``on_paths``, ``letter_sizes``: those along paths.  ``rooms``: frames that words wrap in.
- ``lost_clones``: clones that become paths.
- ``plan``, ``placing``: what there shall be in which groups, and putting it there.
- ``courses``, ``looks``, ``sheets``, ``empty_layers``: how elements run and look; page, guides, bare layers.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
