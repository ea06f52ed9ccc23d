"""The command ``curvebench``; in a checkout, ``python -m app`` is the same."""

import os
import sys


def main() -> int:
    """Run the command line and return its exit code."""
    # NumPy reads it at its import. A second thread takes the window's processor, and waits for it in a loop:
    # at the sizes here nothing is done sooner, and the window stood still for seconds during a fit.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # Qt takes this one instead, and would say so on stderr at every start.
    if os.environ.get("LC_ALL") in ("C", "POSIX"):
        os.environ["LC_ALL"] = "C.UTF-8"
    try:
        from .cli import main as run  # noqa: PLC0415 - it needs what the next lines are about

        return run()
    except ModuleNotFoundError as problem:
        missing = (problem.name or "").partition(".")[0]
        if missing in {__package__, "curvecore", ""}:
            raise
        print(
            f"curvebench: The editor needs the package {missing}: pip install 'curvebench[app]'.",
            file=sys.stderr,
        )
        return 1


if __name__ == "__main__":
    sys.exit(main())
