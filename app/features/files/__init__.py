"""Files of documents: new, open, save, quit; and the file on the disk while it is open.

- ``commands``: the actions, and the progress of long work.
- ``disk``: a file that another program changed or deleted, or that is open elsewhere.
"""
