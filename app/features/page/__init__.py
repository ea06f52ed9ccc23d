"""The page: what pictures of the document show.

- ``commands``: its edge on the canvas; a page around the curves, and none.
"""
