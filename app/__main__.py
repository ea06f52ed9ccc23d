"""Makes ``python -m app`` the same as ``curvebench``."""

import sys

from .cli import main

sys.exit(main())
