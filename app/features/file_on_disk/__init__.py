"""The document's file while it is open: changed, gone, or open elsewhere.

- ``commands``: keeps what is shown in step with the disk, and does what is offered.
- ``notices``: what is said and offered.
"""
