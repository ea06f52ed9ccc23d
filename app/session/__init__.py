"""The one mutable owner: the current document, its history, the selection and the file behind it.

- ``session``: the QObject composed of the plain objects below; `Session.change` is the one door by which the
  document changes.  ``signals``: what it tells, several signals of one thing as a whole,
  and sentences for the person.
- ``change``: what became of a change, and why one is refused.
- ``history``: the steps that can be undone.  ``views``: the view-models of the curves shown.
- ``selected``: selected points and curves, the point under the pointer.  ``selection``: ways to select.
- ``following``: the selection from document to document.  ``scrub_line``: a t that is shown.
- ``box``: what the box around what is selected turns about, and what its grips do.
- ``highlight``: what Copy, Cut, Duplicate and Delete act on.
- ``files``: the file behind the document.
"""

from .change import Change
from .history import DocumentOrigin
from .session import Session
from .signals import Message, MessageKind

__all__ = ["Change", "DocumentOrigin", "Message", "MessageKind", "Session"]
