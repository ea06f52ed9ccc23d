"""Settings: what is remembered between starts.

- ``preferences``: each of them, as a descriptor.
- ``kinds``: the kinds of settings that there are.  ``file``: the ini file that holds them.
"""
