"""Press, move and release turned into edits. No Qt: a tool is tested with plain `Pointer` records.

- ``tool``: the base class of the tools, the event of an event with its settings, and the registry of those
  in ``canvas``, which a person chooses; what a tool can ask of the plot.  ``toolbox``: those of one plot.
- ``explain``, ``move_image``: tools of the canvas that belong to features.
  ``rail``: those over t, and the drag of ticks.
- ``pointer``: position, keys, and what lies under the pointer.
- ``gesture``: what happens from a press to the release, and the drag that changes the document.
- ``drag_points``, ``drag_handles``, ``bend``: drags, each from the press to the undo step.
- ``offsets``: offsets in the plane.  ``editing_session``: the session as tools see it.
- ``drag_machine``: the state machine all drags share: threshold, preview, commit, cancel.
- ``drag``: the base class of the drags.  ``drags``, ``pen_drags``: what each makes of the document.
- ``transform``, ``transform_box``: move, scale and rotate; the box with grips.  ``typed_amount``: the number,
  or the two, typed meanwhile.  ``target``: what these act on: selected points, or curves.
  ``transform_drags``: the drags that do, by mouse and by key, and that of the pivot.
- ``curve_picker``: other curves, selected and dragged.  ``marquee``: points in a rubber band.
- ``snapping``: what a point snaps to.  ``snap_targets``, ``snappers``: which of it for which gesture.
- ``guides``: guides drawn out of a ruler and dragged.
- ``marks``: what a gesture shows over the drawing.
- ``pen_session``: what the pen knows of the curves that it draws.
- ``pencil_detail``: how near a curve comes to what the pencil draws.
- ``background``: what takes a tool longer than a moment.
- ``hints``: what a press would do, in words.
"""
