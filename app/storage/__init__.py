"""Documents on disk: the file format, atomic writing, locks and snapshots.

- ``format``: documents to and from bytes, strictly; ``coding``: values that are no plain JSON values;
  ``validation``: what goes beyond types; ``format_error``: refusals, in words.
  ``image_path``: where the file of a picture lies.
- ``migration``: older versions of the format, step by step.
  ``repeated_keys``: what typed decoding passes over.  ``setting_check``: settings of families.
  ``field_check``: what each field may hold.  ``unread``: files of other programs that are none.
- ``files``: bytes to and from disk, so that nothing is ever half written, and who may read
  them; ``temporary``: temporary files, and removing stale ones; ``reasons``: why something failed, in words.
- ``lock``: lock files that name their owner; ``system_lock``: locks of the operating system, on files and
  folders; ``processes``, ``ps``: whether a process still runs.  ``digests``: SHA-256.
- ``open_file``: the file behind an open document: what was seen of it, and the lock.
- ``recovery``: snapshots of what is not saved.
- ``resources``: what ships with the program.  ``examples``: the documents among that.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
