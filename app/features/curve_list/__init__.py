"""The list of curves: which one is edited, what each is called and how it is shown.

- ``panel``: the list with its buttons.  ``view``, ``model``: the list for Qt.
- ``controller``: turns what is clicked, dragged and typed into changes of the document.
"""
