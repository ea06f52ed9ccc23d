"""Press, move and release turned into edits. No Qt: a gesture is tested with plain `Pointer` records.

- ``pointer``: what the pointer is at, and what lies under it.
- ``machine``: the state machine all drags share: threshold, preview, commit, cancel.
- ``drags``: what each drag makes of the document.
- ``pen``, ``pen_drags``: points appended and inserted, and another curve begun.
- ``bend_drag``: the curve itself, grabbed and bent.
- ``transform``, ``transform_box``: move, scale and rotate the selection by keys, or by the grips of a box.
- ``typed_amount``: the number, or the two, typed meanwhile.
- ``subject``: what these act on: selected points, or chosen curves.  ``choosing``: other curves, chosen and
  dragged.
- ``marquee``, ``measure``: gestures that change nothing in the document.
- ``snapping``: what a point is drawn to.  ``magnets``: which of it for which gesture.
- ``overlay``: what a gesture shows over the drawing.
- ``hints``: what a press would do, in words.
- ``tools``: Select, Add points and Measure: which gesture a press begins.  ``words``: numbers for people.
- ``image_tool``: the picture to trace, moved and scaled.
- ``rail``, ``rail_drags``: the gestures of the basis panel: ticks and the scrub line.
- ``closing``: the pen on the first point, which closes the curve.
"""
