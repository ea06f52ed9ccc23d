"""ezdxf, an extra, imported when a DXF file is read or written."""

import ezdxf
from ezdxf.colors import aci2rgb
from ezdxf.math import BSpline
from ezdxf.path import Command, make_path

__all__ = ["BSpline", "Command", "aci2rgb", "ezdxf", "make_path"]
