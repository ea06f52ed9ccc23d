"""Gives a checkout that is installed in place the name by which a wheel installs it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

_MODULE = """\
# The folder `app` of the checkout, under the name by which a wheel installs it.
import sys
from importlib.util import module_from_spec, spec_from_file_location

_spec = spec_from_file_location(__name__, {initial!r})
sys.modules[__name__] = module_from_spec(_spec)
_spec.loader.exec_module(sys.modules[__name__])
"""


class EditableName(BuildHookInterface):
    """Adds a module ``curvebench`` to an editable installation, whose folder is called ``app``."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Write the module, for the builder to take in."""
        if version == "editable":
            module = Path(self.directory) / "curvebench.py"
            module.parent.mkdir(parents=True, exist_ok=True)
            initial = str(Path(self.root) / "app" / "__init__.py")
            module.write_text(_MODULE.format(initial=initial), encoding="utf-8")
            build_data["force_include_editable"] = {str(module): "curvebench.py"}

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Take the module away again."""
        for path in build_data["force_include_editable"]:
            Path(path).unlink()
