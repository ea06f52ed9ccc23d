"""Features: one package for each capability, with its commands and its panel. None imports another.

- ``recovery``: backups of unsaved work, and what a crash left behind.
- ``file_on_disk``: the document's file while it is open: changed, gone, or open elsewhere.
"""
