# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of functions as numbers and arrays, and broadcasting over leading axes for compiled functions that work on rows."""

import difflib
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gyrostat.errors import DomainError

__all__ = ["Floats", "array", "arrays", "complexes", "finite_rows", "number", "numbers", "record", "rows", "shaped", "whole"]

Floats = NDArray[np.float64]


def array(name: str, value: ArrayLike) -> Floats:
    """An argument as an array of doubles. Raises DomainError for what is none: text, dates, complex numbers, rows of different length, None, masked elements."""
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        raise DomainError(f"{name}: elements are masked; leave them out or give them a value")
    try:
        made = np.asarray(value)
        if made.dtype == np.float64:
            return made
        if made.dtype.kind in "biuf" or (made.dtype.kind == "O" and not any(each is None for each in made.flat)):
            return made.astype(np.float64)
    except (TypeError, ValueError, OverflowError):
        pass
    raise DomainError(f"{name} = {str(value)[:60]}: not an array of numbers")


def arrays(**named: ArrayLike) -> dict[str, Any]:
    """Arguments as arrays of doubles, by name."""
    return {name: array(name, value) for name, value in named.items()}


def number(name: str, value: ArrayLike) -> float:
    """An argument as one number. Raises DomainError for what is none."""
    made = array(name, value)
    if made.ndim:
        raise DomainError(f"{name}: one number is wanted, not an array of the shape {made.shape}")
    return float(made)


def numbers(**named: ArrayLike) -> dict[str, Any]:
    """Arguments as one number each, by name."""
    return {name: number(name, value) for name, value in named.items()}


def whole(name: str, value: ArrayLike) -> int:
    """An argument as a whole number. Raises DomainError for what is none."""
    made = number(name, value)
    if not math.isfinite(made) or made != math.floor(made):
        raise DomainError(f"{name} = {made:g}: give a whole number")
    return int(made)


def finite_rows(named: Sequence[tuple[str, ArrayLike, tuple[int, ...]]]) -> tuple[tuple[int, ...], list[Floats]]:
    """`rows`, none of whose numbers is NaN or infinite."""
    lead, made = rows(named)
    for (name, _, core), values in zip(named, made, strict=True):
        good = np.isfinite(values).all(axis=tuple(range(1, 1 + len(core))))
        if not np.all(good):
            row = int(np.argmin(good))
            raise DomainError(f"{name}, row {row} = {values[row].tolist()}: give finite numbers")
    return lead, made


def record(what: str, given: Mapping[str, Any], wanted: Iterable[str], optional: Iterable[str] = ()) -> None:
    """Raises DomainError for what is no mapping, for a key that is missing, and for one that is not known."""
    if not isinstance(given, Mapping):
        raise DomainError(f"{what} = {str(given)[:60]}: give a mapping of {', '.join((*wanted, *optional))}")
    if lacking := [name for name in wanted if given.get(name) is None]:
        raise DomainError(f"{what} has no {', '.join(lacking)}")
    known = (*wanted, *optional)
    for name in given:
        if name not in known:
            near = difflib.get_close_matches(str(name), known, 1)
            raise DomainError(f"{what}: there is no key {name}" + (f"; did you mean {near[0]}?" if near else f": use {', '.join(known)}"))


def rows(named: Sequence[tuple[str, ArrayLike, tuple[int, ...]]]) -> tuple[tuple[int, ...], list[Floats]]:
    """Common leading shape, and each argument as rows (n, *core) of it.

    named : (name, value, core shape) an argument. Raises DomainError for a wrong core shape, for leading axes that do not
    broadcast, and for what is no array of numbers.
    """
    arrays: list[tuple[str, Floats, tuple[int, ...]]] = []
    for name, value, core in named:
        made = array(name, value)
        if len(core) > made.ndim or (core and made.shape[-len(core):] != core):
            raise DomainError(f"{name}: the shape is {made.shape}, not (..., {', '.join(map(str, core))})")
        arrays.append((name, made, core))
    leads = {made.shape[: made.ndim - len(core)] for _, made, core in arrays}
    try:
        lead = leads.pop() if len(leads) == 1 else np.broadcast_shapes(*leads)
    except ValueError as error:
        shapes = ", ".join(f"{name} {made.shape}" for name, made, _ in arrays)
        raise DomainError(f"the leading axes do not broadcast: {shapes}") from error
    count = math.prod(lead)
    spread = (made if made.shape == (*lead, *core) else np.broadcast_to(made, (*lead, *core)) for _, made, core in arrays)
    return lead, [np.ascontiguousarray(made).reshape(count, *core) for made, (_, _, core) in zip(spread, arrays, strict=True)]


def shaped(values: Any, lead: tuple[int, ...], *core: int) -> Any:
    """Rows back in their leading shape; a scalar where nothing is left."""
    made = np.asarray(values).reshape((*lead, *core))
    return made[()] if made.ndim == 0 else made


def complexes(real: Floats, imaginary: Floats) -> NDArray[np.complex128]:
    """Complex numbers of their parts; an infinite part leaves the other as it is."""
    made = np.empty(np.shape(real), dtype=np.complex128)
    made.real, made.imag = real, imaginary
    return made


def in_range(what: str, values: Floats) -> Floats:
    """A result that is no overflow. Raises DomainError for one that is."""
    if not np.all(np.isfinite(values)):
        raise DomainError(f"{what} is beyond the greatest double: give arguments of another size")
    return values
