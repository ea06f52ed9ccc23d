"""Documents on disk: the file format, atomic writing, locks and snapshots.

- ``format``: documents to and from bytes, strictly.  ``image_path``: where the file of a picture lies.
- ``migration``: older versions of the format, step by step.  ``all_within``: a quick look at many numbers.
  ``repeated_keys``: what typed decoding passes over.
- ``files``: bytes to and from disk, so that nothing is ever half written; ``file_access``: who may read
  them; ``temporary``: temporary files, and removing stale ones.
- ``lock``: lock files that name their owner; ``system_lock``: locks of the operating system, on files and
  folders; ``processes``: whether a process still runs.
- ``open_file``: the file behind an open document: what was seen of it, and the lock.
- ``recovery``: snapshots of what is not saved.
"""
