"""The command ``curvebench``; in a checkout, ``python -m app`` is the same."""

import sys


def main() -> int:
    """Run the command line and return its exit code."""
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
