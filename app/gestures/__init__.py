"""Press, move and release turned into edits. No Qt: a gesture is tested with plain `Pointer` records.

- ``pointer``: what the pointer is at, and what lies under it.
- ``machine``: the state machine all drags share: threshold, preview, commit, cancel.
- ``drags``: what each drag makes of the document.
- ``tools``: Select and Add points: which drag a press begins.
- ``rail``: the gestures of the basis panel: ticks and the scrub line.
"""
