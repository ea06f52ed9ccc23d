"""Documents on disk: the file format, complete writes, locks and snapshots.

In reading order:

- ``files``: load and save documents, read and write bytes.
- ``format``: documents to and from bytes.  ``coding``: values that are no JSON values.  ``validation``: the
  requirements beyond types.  ``format_error``: refusals in words.
- ``migration``: older versions of the format.
- ``open_file``: the file of an open document, its lock, and what other programs did to it.
- ``lock``: lock files that name their owner.  ``system``: processes and locks of the operating system.
  ``digests``: SHA-256.
- ``recovery``: snapshots of unsaved work.
- ``resources``: files that ship with the program.  ``examples``: the documents among them.

To raise the file version: raise `format.VERSION` and the literal in `format._File`; add to
`migration.MIGRATIONS` a function that turns the plain values of a file of the last version into those of the
new one; add a row to `migration.DROPPED` for each field that goes, and a case to
tests/storage/test_migration.py. No other module knows about old versions.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
