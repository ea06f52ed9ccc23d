"""The owner of the open document, its history, the selection and the file behind it.

- ``session``: the QObject with its signals, composed of the objects below. The document changes by
  `Session.change`, or by a gesture: `preview`, then `commit` or `cancel`. Both ways make their undo step in
  `Session._make_step`, which refuses the whole change where it would change a locked curve.
- ``change``: the result of a change, the reasons to refuse one, and messages to the person.
- ``selection``: selected points and curves and how they follow the document; what Copy, Cut and Delete act
  on; the box around the selection; the scrub line.
- ``history``: the steps that can be undone.  ``views``: the views of the curves.
- ``files``: the file behind the document.
"""

from .change import Change, Message, MessageKind
from .history import DocumentOrigin
from .session import Session

__all__ = ["Change", "DocumentOrigin", "Message", "MessageKind", "Session"]
