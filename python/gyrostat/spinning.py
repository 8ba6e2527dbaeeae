# SPDX-License-Identifier: BSD-3-Clause
"""A thrusting, charged gyrostat that spins about its axis 3, over arrays: the functions of families/spinning."""

from gyrostat.families.spinning import functions
from gyrostat.families.spinning.functions import *  # noqa: F403
from gyrostat.families.spinning.scene import arguments

__doc__ = functions.__doc__
__all__ = ["arguments"]
__all__ += functions.__all__
