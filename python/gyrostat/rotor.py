# SPDX-License-Identifier: BSD-3-Clause
"""A gyrostat whose rotor is driven by a motor, over arrays: the functions of families/rotor."""

from gyrostat.families.rotor import functions
from gyrostat.families.rotor.functions import *  # noqa: F403
from gyrostat.families.rotor.scene import arguments

__doc__ = functions.__doc__
__all__ = ["arguments"]
__all__ += functions.__all__
