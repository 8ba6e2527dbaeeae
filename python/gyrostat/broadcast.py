# SPDX-License-Identifier: BSD-3-Clause
"""Broadcasting over leading axes, for compiled functions that work on rows."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gyrostat.errors import DomainError

__all__ = ["Float", "Floats", "rows", "shaped"]

Float = np.float64
Floats = NDArray[np.float64]


def rows(named: Sequence[tuple[str, ArrayLike, tuple[int, ...]]]) -> tuple[tuple[int, ...], list[Floats]]:
    """Common leading shape, and each argument as rows (n, *core) of it.

    named : (name, value, core shape) an argument. Raises DomainError for a wrong core shape, for leading axes that do not
    broadcast, and for what is no array of numbers.
    """
    arrays: list[tuple[str, Floats, tuple[int, ...]]] = []
    for name, value, core in named:
        try:
            array = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise DomainError(f"{name} = {str(value)[:60]}: not an array of numbers") from error
        if len(core) > array.ndim or (core and array.shape[-len(core):] != core):
            raise DomainError(f"{name}: the shape is {array.shape}, not (..., {', '.join(map(str, core))})")
        arrays.append((name, array, core))
    leads = {array.shape[: array.ndim - len(core)] for _, array, core in arrays}
    try:
        lead = leads.pop() if len(leads) == 1 else np.broadcast_shapes(*leads)
    except ValueError as error:
        shapes = ", ".join(f"{name} {array.shape}" for name, array, _ in arrays)
        raise DomainError(f"the leading axes do not broadcast: {shapes}") from error
    count = math.prod(lead)
    spread = (array if array.shape == (*lead, *core) else np.broadcast_to(array, (*lead, *core)) for _, array, core in arrays)
    return lead, [np.ascontiguousarray(array).reshape(count, *core) for array, (_, _, core) in zip(spread, arrays, strict=True)]


def shaped(values: Any, lead: tuple[int, ...], *core: int) -> Any:
    """Rows back in their leading shape; a scalar where nothing is left."""
    made = np.asarray(values).reshape((*lead, *core))
    return made[()] if made.ndim == 0 else made
