"""Background work: tasks in threads, their progress, garbage collection, and limits for child processes.

- ``task``: `Task`, and its owners `SingleTask` and `DebouncedTask`.
- ``progress``: the `Report` that work calls with its share done, and that cancels it. No Qt.
- ``garbage``: garbage collected from the event loop alone.
- ``processor_limit``: processor time that a child process may use. No Qt.

To run work in the background: write a function that takes a `Report` and immutable values, calls the report
now and then (`with_progress` does in a loop), and returns a value; pass it to ``SingleTask.start`` or
``DebouncedTask.ask``, which call back in the window's thread.
"""
