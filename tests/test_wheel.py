"""The wheel: installed beside a stranger's own ``app.py``, and without the editor's packages."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
WITHOUT = """
import sys

for name in ("PySide6", "pyqtgraph", "msgspec", "lazy_loader", "simpleeval", "defusedxml", "svgelements"):
    sys.modules[name] = None
"""


def python_m(*words):
    subprocess.run([sys.executable, "-m", *words], cwd=ROOT, check=True, capture_output=True)


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A folder with what the wheel installs; the checkout is not on the path of who uses it."""
    folder = tmp_path_factory.mktemp("wheel")
    python_m("hatchling", "build", "-t", "wheel", "-d", folder)
    (wheel,) = folder.glob("*.whl")
    # Most modules are compiled for nobody: an example imports some of them.
    options = ("-q", "--no-deps", "--no-index", "--no-compile", "--disable-pip-version-check")
    python_m("pip", "install", *options, "--target", folder / "site", wheel)
    return folder / "site"


@pytest.fixture
def run(installed, tmp_path):
    """Runs Python in a folder where a stranger has an ``app.py`` of his own."""
    (tmp_path / "app.py").write_text("mine = True\n", encoding="utf-8")

    def run(*words):
        # Without a display or a hint for Qt: there it aborted.
        hidden = {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}
        environment = {key: value for key, value in os.environ.items() if key not in hidden}
        environment["PYTHONPATH"] = os.pathsep.join((str(tmp_path), str(installed)))
        # With pytest-qt alone: what other plugins of pytest are installed here, nobody else needs to have.
        environment |= {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTEST_PLUGINS": "pytestqt.plugin"}
        return subprocess.run(
            [sys.executable, *words],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )

    return run


def test_nothing_called_app_is_installed(installed):
    named = {path.name for path in installed.iterdir() if path.suffix != ".dist-info"}
    assert named - {"bin"} == {"curvebench", "curvecore"}


@pytest.mark.window
def test_the_editor_is_driven_beside_a_strangers_app(run, tmp_path):
    """The README's example, and the stranger's module is still his."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    body = text.split("## Testing with pytest-qt\n", 1)[1].split("\n## ", 1)[0]
    conftest, test = re.findall(r"```python\n(.*?)```", body, re.DOTALL)
    (tmp_path / "conftest.py").write_text(conftest, encoding="utf-8")
    own = "\n\ndef test_his_module_is_his():\n    import app, sys\n\n    assert app.mine\n"
    own += "    assert not [name for name in sys.modules if name.startswith('app.')]\n"
    (tmp_path / "test_example.py").write_text(test + own, encoding="utf-8")
    result = run("-m", "pytest", "-q", "-p", "no:cacheprovider")
    assert "2 passed" in result.stdout, result.stdout + result.stderr


def test_resources_of_the_installed_program_are_inside_the_package(run, installed):
    result = run("-c", "from curvebench.storage import resources as r; print(r.resource('icons', 'app.svg'))")
    assert Path(result.stdout.strip()).is_relative_to(installed), result.stderr


def test_without_the_editors_packages_the_command_names_the_installation(run):
    result = run("-c", f"{WITHOUT}\nfrom curvebench.__main__ import main; sys.exit(main())")
    assert result.returncode == 1
    (line,) = result.stderr.splitlines()
    assert line.endswith("pip install 'curvebench[app]'.")


def test_without_the_editors_packages_the_core_imports(run):
    code = "from curvecore import LagrangeCurve; print(LagrangeCurve([[0], [1]], [0, 1]).evaluate(0.5))"
    result = run("-c", f"{WITHOUT}\n{code}")
    assert result.stdout.strip() == "[0.5]", result.stderr


def test_a_missing_module_of_the_program_itself_is_no_missing_package(run):
    """A defect is told as one."""
    code = "import sys; sys.modules['curvebench.cli'] = None\nfrom curvebench.__main__ import main; main()"
    result = run("-c", code)
    assert "ModuleNotFoundError" in result.stderr
    assert "pip install" not in result.stderr
