"""Work beside the window's thread.

- ``progress``: how long work reports how far it is, and hears that it was cancelled. No Qt.
- ``task``: one piece of work in a thread; its end in the window's thread.
- ``garbage``: garbage collected from the event loop alone, never in a thread or in a destructor of Qt's.
- ``generations``: when each generation of garbage is due. No Qt.
- ``single_task``: what a person starts, one at a time.  ``debounced_task``: what follows a value.
- ``processor_limit``: processor time that a child process may use. No Qt.
- ``owner``: what both share, and how all of them end.
"""
