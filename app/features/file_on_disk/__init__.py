"""The document's file while it is open: changed, gone, or open elsewhere.

- ``watch``: notices that the file or its folder may have changed.
- ``commands``: keeps what is shown in step with the disk, and does what is offered.
- ``notices``: what is said and offered.  ``bar``: where that is shown.
"""
