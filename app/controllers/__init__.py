"""Controllers: by them what the person did in a panel becomes a change of the document.

A panel holds no session: it shows a value and emits what the person meant. Its controller connects that to
`Session.change`, and tells the panel why something was refused. Those of a feature are in its package.

- ``rail``: a t typed at its tick.
"""
