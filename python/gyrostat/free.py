# SPDX-License-Identifier: BSD-3-Clause
"""A body with wheels that no torque acts on, over arrays: the functions of families/free."""

from gyrostat.families.free import functions
from gyrostat.families.free.functions import *  # noqa: F403
from gyrostat.families.free.scene import arguments

__doc__ = functions.__doc__
__all__ = ["arguments"]
__all__ += functions.__all__
