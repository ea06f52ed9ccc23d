"""Files of documents: new, open, save, quit, and what is read or written beside the window.

- ``commands``: the actions.  ``work_commands``, ``job_bar``: progress of long work, and stopping it.
"""
