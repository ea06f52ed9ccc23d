"""Progress of reading, writing and computing, and stopping it."""

from __future__ import annotations

from ...actions.declaration import action
from ...actions.menus import EDIT_WORK
from ...actions.needs import Need
from ...workbench.context import WindowContext
from .job_bar import JobBar


class WorkCommands:
    """Shows in the status line what goes on beside the window, and stops it."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._bar: JobBar | None = None
        jobs = context.work.jobs
        jobs.begun.connect(lambda: context.store.change(is_working=True))
        jobs.shown.connect(self._show_bar)
        jobs.ended.connect(self._hide_bar)
        jobs.progressed.connect(self._show_share)

    @action(
        "cancelWork",
        "Stop What Is Running",
        EDIT_WORK,
        "Ctrl+.",
        "stop",
        needs=Need(
            "something that is being read, written or computed", lambda state: state.window.is_working
        ),
    )
    def _cancel(self) -> None:
        """Stop reading, writing or computing; nothing changes."""
        self._context.work.cancel()

    def _show_bar(self, title: str) -> None:
        if self._bar is None:
            self._bar = JobBar(self._context.actions["cancelWork"])
            self._context.status_line.put_after(self._bar)
        self._bar.begin(title)

    def _hide_bar(self) -> None:
        self._context.store.change(is_working=False)
        if self._bar is not None:
            self._bar.hide()

    def _show_share(self, share: float, _word: str) -> None:
        if self._bar is not None:
            self._bar.bar.show_share(share)
