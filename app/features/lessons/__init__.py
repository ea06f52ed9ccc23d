"""Lessons: why a curve goes where it goes, step by step.

To add a lesson: make a folder `NN_name` in `resources/lessons` with

- `lesson.md`: the first heading is the title, the paragraph below it the summary in the list of lessons.
  Every second-level heading begins a step, with a comment of fields that semicolons separate::

      <!-- curve: Careless; show: overlayBand; set: epsilon 0.02; goal: lebesgue < 5; keep: points, family -->

  `curve` names the curve to edit, `show` the actions to switch on, `set` the settings of the analysis
  (`lesson.SETTINGS`). A step with a `goal` also needs `curve`, which must meet it, and `keep`: what must
  stay as it is meanwhile. A link to `action:NAME` triggers that action.

  `view_model/analysis/goals.py` has two tables: `MEASURES` for `goal`, `KEPT` for `keep`. Most measures are
  numbers; `family` and `rule` are words, those of documents: `family = quintic_hermite` (a `name` in
  `curvecore/families`), `rule = chord_length` (a value of `ParametrizationKind`).
- `document.curve.json`: the document of the lesson, as the program saves it.
- `lesson.py`, where the text has a number or a step has a goal. The tests call its functions:

  - `claims(lesson)` yields quotes of the text, each with the values of the numbers in it
    (``tests/lesson_facts.py`` computes them). Every number of the text needs one, also a number in words:
    "twice", "eleven", "half".
  - `reach_goal_N(editor)` does what step N asks for, by real events. Every goal needs one.
  - `do_step_N(editor)` does what step N asks for apart from a goal.

  The docstrings of the last two quote the text. `MEASURES` and `KEPT` add to the tables of goals.
  `05_sensitivity` is an example.

Nothing else has to be touched: the folders are found by listing them. ``tests/gui/test_lessons.py`` and
``tests/view_model/test_lesson_claims.py`` try every lesson. The Python of a lesson runs only where the lesson
comes with the program; a lesson from anywhere else is text and a document.

- ``lesson``: the text, read into steps.  ``commands``: opens documents, goes from step to step, checks goals.
- ``panel``: the list of lessons, and the text of a step.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
