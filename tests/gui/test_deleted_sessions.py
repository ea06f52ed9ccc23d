"""Deleted sessions, in a separate process: the garbage collector does not crash it."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

CODE = """
import gc, random
from PySide6.QtGui import QGuiApplication
from app.document.model import make_curve
from app.session import Session

app = QGuiApplication([])
gc.disable()
# Collections look at the sessions alone, not at all that was imported.
gc.freeze()
random.seed(1)
pool = []
for number in range(300):
    session = Session()
    for step in range(random.randrange(5)):
        points = [(float(number), float(step)), (1.0, 1.0)]
        session.change("x", lambda document: document.with_curve(0, make_curve(points)))
    stack = session.undo_stack
    held = [stack.command(random.randrange(stack.count())) if stack.count() else None]
    if random.random() < 0.5:
        held.append(stack)
    if random.random() < 0.5:
        held.insert(0, session)
    pool.append(held)
    del session, stack, held
    random.shuffle(pool)
    gc.collect(random.randrange(3))
    del pool[8:]
pool.clear()
gc.collect()
print("alive")
"""


def test_undo_steps_of_a_deleted_session_are_deleted_once():
    """In an unlucky order the collector deleted the steps, and the stack deleted them again."""
    done = subprocess.run([sys.executable, "-c", CODE], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "alive\n"
