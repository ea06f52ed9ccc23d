"""Makes ``python -m app`` the same as ``curvebench``."""

import sys

from app.cli import main

sys.exit(main())
