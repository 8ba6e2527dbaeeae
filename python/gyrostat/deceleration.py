# SPDX-License-Identifier: BSD-3-Clause
"""Deceleration of a body in a resistive medium, over arrays: the functions of families/deceleration."""

from gyrostat.families.deceleration import functions
from gyrostat.families.deceleration.functions import *  # noqa: F403
from gyrostat.families.deceleration.scene import arguments

__doc__ = functions.__doc__
__all__ = ["arguments"]
__all__ += functions.__all__
