"""Reports of pytest-xdist's workers, without those that no terminal shows.

Of a test that passes, the line of dots shows the call alone. To send that its set-up and its teardown passed,
that it begins and that it ends takes the worker, and the process that all workers report to, longer than many
a test takes. Options that show more than dots get all of it.
"""

from __future__ import annotations


def pytest_configure(config):
    option = config.option
    shows_more = (
        option.verbose > 0 or option.durations or option.xmlpath or set("pPA") & set(option.reportchars)
    )
    if shows_more or not hasattr(config, "workerinput"):
        return
    for plugin in config.pluginmanager.get_plugins():
        if type(plugin).__name__ == "WorkerInteractor":
            _send_news_alone(plugin)


def _send_news_alone(interactor) -> None:
    send = interactor.sendevent

    def sendevent(name: str, **event) -> None:
        if name not in ("logstart", "logfinish") and not ("data" in event and _is_no_news(event["data"])):
            send(name, **event)

    interactor.sendevent = sendevent


def _is_no_news(report: dict) -> bool:
    is_beside_call = report.get("when") in ("setup", "teardown")
    return is_beside_call and report["outcome"] == "passed" and not report["user_properties"]
