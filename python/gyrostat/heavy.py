# SPDX-License-Identifier: BSD-3-Clause
"""A heavy body that turns about a fixed point, over arrays: the functions of families/heavy."""

from gyrostat.families.heavy import functions
from gyrostat.families.heavy.functions import *  # noqa: F403
from gyrostat.families.heavy.scene import arguments

__doc__ = functions.__doc__
__all__ = ["arguments"]
__all__ += functions.__all__
