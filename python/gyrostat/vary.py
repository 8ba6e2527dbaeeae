# SPDX-License-Identifier: BSD-3-Clause
"""What varies from row to row of a study: random numbers, grids and tables of cases, and the values that a row gets.

A value is a function of the seed, the number of its row and the name of its key alone, so that rows can be had in any order and in any parts.
"""

import csv
import difflib
import hashlib
import math
import os
import re
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property, partial
from numbers import Real
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.errors import DomainError, Refused
from gyrostat.units import quantity

__all__ = ["DESIGNS", "Axis", "Plan", "Spread", "Varied", "as_varied", "choice", "grid", "linspace", "logspace", "lognormal", "normal", "number_in",
           "read_cases", "read_words", "told_of", "uniform"]

Floats = NDArray[np.float64]
Number = float | str  # a text: with a unit, "3 deg/s", or a share, "5%"; where words are taken one of them
# Takes a number as it was given to what the compiled core takes.
Reader = Callable[[Number], float]

DESIGNS: Final = ("random", "sobol", "latin-hypercube", "saltelli")


@dataclass(frozen=True, slots=True)
class Spread:
    """A random number."""

    name: str
    arguments: tuple[Number, ...]

    def __post_init__(self) -> None:
        _require_numbers(self.name, self.arguments)

    def __str__(self) -> str:
        return f"{self.name}({', '.join(map(_text, self.arguments))})"

    def quantiles(self, read: Reader) -> Callable[[Floats], Floats]:
        """What gives the values at shares of the probability, (n,) in (0, 1). Raises DomainError."""
        made: Callable[[Floats], Floats] = _QUANTILES[self.name](self, read)
        return made


@dataclass(frozen=True, slots=True)
class Axis:
    """Values that are taken one after the other, each with all of every other axis: an axis of a grid."""

    name: str  # list, linear, log
    arguments: tuple[Number, ...]  # the values; else the ends
    count: int = 0

    def __post_init__(self) -> None:
        _require_numbers("a grid", self.arguments)
        if isinstance(self.count, bool) or not isinstance(self.count, int | np.integer):
            raise DomainError(f"a grid: {self.count!r} is no whole number of values")
        object.__setattr__(self, "count", int(self.count))
        if not self.arguments:
            raise DomainError("a grid: give at least one value")

    def __str__(self) -> str:
        if self.name == "list":
            return f"[{', '.join(map(_text, self.arguments))}]"
        return f"{':'.join(map(_text, self.arguments))}:{self.count}{'log' if self.name == 'log' else ''}"

    def __len__(self) -> int:
        return len(self.arguments) if self.name == "list" else self.count

    def ends(self, read: Reader) -> Floats:
        """The numbers that stand for it: those of a list, else the first and the last. Raises DomainError."""
        numbers = np.array([read(value) for value in self.arguments])
        if self.name == "list":
            return numbers
        if self.count < 2 or not -math.inf < numbers[0] < numbers[1] < math.inf or (self.name == "log" and not numbers[0] > 0):
            raise DomainError(f"{self}: give two ends, the smaller first{' and positive' if self.name == 'log' else ''}, and at least 2 values")
        if self.count > MOST_VALUES:
            raise DomainError(f"{self}: give at most {MOST_VALUES} values")
        return numbers

    def at(self, places: NDArray[np.int64], ends: Floats) -> Floats:
        """The values at some places, counted from 0."""
        made: Floats
        if self.name == "list":
            made = ends[places]
            return made
        last, (low, high) = self.count - 1, np.log10(ends) if self.name == "log" else ends
        inside = low + places * ((high - low) / last)
        made = np.where(places == 0, ends[0], np.where(places == last, ends[1], 10.0**inside if self.name == "log" else inside))
        return made


Varied = Spread | Axis
MOST_VALUES: Final = 2**31 - 1  # of a grid of one key
MOST_SOBOL: Final = 2**30  # points of a sequence, as scipy makes it
MOST_LATIN: Final = 2**27  # numbers of a hypercube, 1 GiB


def _require_numbers(what: str, arguments: Iterable[Any]) -> None:
    for value in arguments:
        if isinstance(value, bool | np.bool_) or not isinstance(value, str | Real):
            raise DomainError(f"{what}: {value!r} is neither a number nor a text with a unit")


def _text(value: Number) -> str:
    return value if isinstance(value, str) else repr(float(value))


# ---- the words ----


def normal(mean: Number, deviation: Number) -> Spread:
    """Normal about `mean`; the standard deviation in the same unit, or as a share of the mean ("5%")."""
    return Spread("normal", (mean, deviation))


def uniform(low: Number, high: Number) -> Spread:
    """Every value between `low` and `high` alike."""
    return Spread("uniform", (low, high))


def lognormal(median: Number, deviation: Number) -> Spread:
    """A number whose natural logarithm is normal, with this standard deviation: 0.2 or "20%"."""
    return Spread("lognormal", (median, deviation))


def choice(*values: Number) -> Spread:
    """One of the values, each as likely."""
    return Spread("choice", values)


def grid(values: Iterable[Number]) -> Axis:
    """All of the values, each with all of every other grid."""
    listed = tuple(values)
    _require_numbers("a grid", listed)
    return Axis("list", tuple(value if isinstance(value, str) else float(value) for value in listed))


def linspace(low: Number, high: Number, count: int) -> Axis:
    """A grid of `count` values from `low` to `high`, as far apart each."""
    return Axis("linear", (low, high), count)


def logspace(low: Number, high: Number, count: int) -> Axis:
    """A grid of `count` values from `low` to `high`, each the same multiple of the one before."""
    return Axis("log", (low, high), count)


_WORDS: Final[dict[str, Callable[..., Varied]]] = {"normal": normal, "uniform": uniform, "lognormal": lognormal, "choice": choice}
_WANTS: Final = {"normal": "two numbers, mean and standard deviation, as normal(0.005, 5%)", "uniform": "two numbers, least and greatest, as uniform(15, 17)",
                 "lognormal": "two numbers, median and standard deviation of the logarithm, as lognormal(1e-4, 20%)", "choice": "values, as choice(1, 2, 5)"}
_ALIASES: Final = {"gauss": "normal", "gaussian": "normal", "unif": "uniform", "range": "uniform"}
_FORMS: Final = "normal(0.005, 5%), uniform(15, 17), lognormal(1e-4, 20%), choice(1, 2, 5), [1, 2, 5], 0:10:11 or 1e-5:1e-3:50log"


@contextmanager
def told_of(key: str) -> Iterator[None]:
    """What is refused in the block is told of this key."""
    try:
        yield
    except DomainError as error:
        raise DomainError(f"{key}: {error}") from None


def _number(text: str) -> Number:
    try:
        return float(text)
    except ValueError:
        return text


def read_words(text: str) -> Varied:
    """What a text such as "normal(0.005, 5%)" stands for. Raises DomainError."""
    text = text.strip()
    if found := re.fullmatch(r"([a-z]+)\s*\((.*)\)", text):
        word = _WORDS.get(found[1])
        arguments = [_number(part.strip().strip("\"'")) for part in found[2].split(",")]
        if word is not None and all(argument != "" for argument in arguments) and (word is choice or len(arguments) == 2):
            return word(*arguments)
        if word is not None:
            raise DomainError(f'"{text}": {found[1]} wants {_WANTS[found[1]]}')
        if near := difflib.get_close_matches(found[1], [*_WORDS, *_ALIASES], 1, 0.6):
            raise DomainError(f'"{text}": there is no {found[1]}; did you mean {_ALIASES.get(near[0], near[0])}? Write {_FORMS}')
    elif found := re.fullmatch(r"\[(.*)\]", text, re.DOTALL):
        values = [part.strip().strip("\"'") for part in found[1].split(",")]
        if all(values):
            return grid([_number(value) for value in values])
    elif found := re.fullmatch(r"([^:]+):([^:]+):\s*(\d+)\s*(log)?", text):
        return (logspace if found[4] else linspace)(_number(found[1].strip()), _number(found[2].strip()), int(found[3]))
    raise DomainError(f'"{text}" does not say how the number varies; write {_FORMS}')


def as_varied(value: Any) -> Varied:
    """A Spread, an Axis, words for one, or values for an axis. Raises DomainError."""
    if isinstance(value, Spread | Axis):
        return value
    if isinstance(value, str):
        return read_words(value)
    try:
        values = list(value) if isinstance(value, list | tuple) else np.asarray(value).ravel().tolist() if np.ndim(value) == 1 else []
    except (TypeError, ValueError):
        values = []
    if not values:
        raise DomainError(f"{str(value)[:60]} does not say how the number varies; write {_FORMS}, or give a list of numbers")
    return grid(values)


def number_in(value: Number, unit: str) -> float:
    """A number in SI units, from a number or a text with a unit of this dimension. Raises DomainError."""
    if not isinstance(value, str):
        return float(value)
    try:
        return quantity(value, unit)
    except Refused as error:
        raise DomainError(f'"{value}": {error}') from None


# ---- quantiles ----


def _deviation(spread: Spread, read: Reader, of: float) -> float:
    """The second argument, of which a share is one of `of`."""
    value = spread.arguments[1]
    share = isinstance(value, str) and value.strip().endswith("%")
    if share and of == 0:
        raise DomainError(f"{spread}: a share of a mean of 0 is 0, and nothing would vary; give the standard deviation as a number, such as normal(0, 0.05)")
    made = number_in(value, "1") * abs(of) if share else read(value)
    if not (made >= 0 and math.isfinite(made)):
        raise DomainError(f"{spread}: give a standard deviation >= 0")
    return made


# Quantiles, as functions of this module: a study goes to other processes.

def _normal_at(mean: float, deviation: float, share: Floats) -> Floats:
    return mean + deviation * _standard_normal(share)


def _lognormal_at(median: float, deviation: float, share: Floats) -> Floats:
    made: Floats = median * np.exp(deviation * _standard_normal(share))
    return made


def _uniform_at(low: float, high: float, share: Floats) -> Floats:
    return low + (high - low) * share


def _choice_at(values: Floats, share: Floats) -> Floats:
    made: Floats = values[(share * len(values)).astype(int)]
    return made


def _normal(spread: Spread, read: Reader) -> Callable[[Floats], Floats]:
    mean = read(spread.arguments[0])
    if not math.isfinite(mean):
        raise DomainError(f"{spread}: give a finite mean")
    deviation = _deviation(spread, read, mean)
    return partial(_normal_at, mean, deviation)


def _lognormal(spread: Spread, read: Reader) -> Callable[[Floats], Floats]:
    median, deviation = read(spread.arguments[0]), _deviation(spread, lambda value: number_in(value, "1"), 1.0)
    if not 0 < median < math.inf:
        raise DomainError(f"{spread}: give a finite median > 0")
    return partial(_lognormal_at, median, deviation)


def _uniform(spread: Spread, read: Reader) -> Callable[[Floats], Floats]:
    low, high = map(read, spread.arguments)
    if not 0 < high - low < math.inf:
        raise DomainError(f"{spread}: give two finite ends, the smaller first")
    return partial(_uniform_at, low, high)


def _choice(spread: Spread, read: Reader) -> Callable[[Floats], Floats]:
    if not spread.arguments:
        raise DomainError(f"{spread}: give at least one value")
    values = np.array([read(value) for value in spread.arguments])
    return partial(_choice_at, values)


_QUANTILES: Final = {"normal": _normal, "lognormal": _lognormal, "uniform": _uniform, "choice": _choice}


def _standard_normal(share: Floats) -> Floats:
    try:
        from scipy.special import ndtri
    except ImportError as error:
        raise ImportError("scipy is not installed: pip install 'gyrostat[xarray]'") from error
    made: Floats = ndtri(share)
    return made


def _draws(seed: int, name: str, rows: range) -> Floats:
    """A random number in (0, 1) for each row: word row % 4 of block row // 4 of the generator Philox 4x64-10 whose key is seed and name."""
    word = int.from_bytes(hashlib.blake2b(name.encode(), digest_size=8).digest(), "little")
    first = rows.start // 4
    # the generator counts on before it makes a block
    counter = (first - 1) % 2**256
    generator = np.random.Philox(key=np.array([seed, word], dtype=np.uint64),
                                 counter=np.array([counter >> 64 * i & 2**64 - 1 for i in range(4)], dtype=np.uint64))
    raw = generator.random_raw(4 * (-(-rows.stop // 4) - first))[rows.start - 4 * first:rows.stop - 4 * first]
    made: Floats = ((raw >> np.uint64(12)).astype(np.float64) + 0.5) * 2.0**-52
    return made


# ---- the rows ----


def read_cases(file: str | os.PathLike[str]) -> dict[str, tuple[Number, ...]]:
    """A table of cases from CSV: keys in the first line, below it a line a case. Raises DomainError."""
    try:
        with Path(file).open(newline="", encoding="utf-8-sig") as stream:
            reader = csv.reader(stream, skipinitialspace=True)
            lines = [(reader.line_num, line) for line in reader if any(part.strip() for part in line)]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise DomainError(f"{file}: the table of cases cannot be read ({getattr(error, 'strerror', None) or error})") from None
    if len(lines) < 2:
        raise DomainError(f"{file}: write the keys into the first line, and below it a line a case")
    keys = [key.strip() for key in lines[0][1]]
    if twice := next((key for key in keys if keys.count(key) > 1), None):
        raise DomainError(f"{file}: {twice} is there twice")
    if len(keys) == 1 and ";" in keys[0]:
        raise DomainError(f"{file}: part the keys and numbers by commas, not by ;")
    for number, line in lines[1:]:
        if len(line) != len(keys):
            raise DomainError(f"{file}: line {number} has {len(line)} values, the first line {len(keys)} keys")
        if empty := next((key for key, part in zip(keys, line, strict=True) if not part.strip()), None):
            raise DomainError(f"{file}: line {number} has no value of {empty}")
    return {key: tuple(_number(line[i].strip()) for _, line in lines[1:]) for i, key in enumerate(keys)}


@dataclass(frozen=True, eq=False)
class Plan:
    """How many rows there are and what each gets. The columns come by key; `readers` knows the numbers of each."""

    vary: Mapping[str, Varied]
    cases: Mapping[str, tuple[Number, ...]]
    readers: Mapping[str, Reader]
    n: int
    seed: int
    design: str

    @classmethod
    def of(cls, vary: Mapping[str, Varied], cases: Mapping[str, tuple[Number, ...]], readers: Mapping[str, Reader], n: int | None, seed: int,
           design: str) -> "Plan":
        """A plan of `n` rows, or of as many as the grid and the table of cases have; 0 where nothing says how many. Raises DomainError."""
        if design not in DESIGNS:
            raise DomainError(f'design = "{design}": use {", ".join(DESIGNS)}')
        if not 0 <= seed < 2**64:
            raise DomainError(f"seed = {seed}: give an integer from 0 to 2^64 - 1")
        if not vary and not cases:
            raise DomainError("nothing varies: say which keys do and how")
        lengths = {len(values) for values in cases.values()}
        if len(lengths) > 1 or 0 in lengths:
            raise DomainError(f"cases: the columns have {', '.join(map(str, sorted(lengths)))} values; give as many of each")
        if both := next((key for key in vary if key in cases), None):
            raise DomainError(f"{both}: it stands in the table of cases, and is to vary beside it")
        for key, each in vary.items():
            with told_of(key):
                each.quantiles(readers[key]) if isinstance(each, Spread) else each.ends(readers[key])
        every = math.prod(cls(vary, cases, readers, 1, seed, design)._shape)
        if n is None:
            n = every if cases or any(isinstance(each, Axis) for each in vary.values()) else 0
        made = cls(vary, cases, readers, n, seed, design)
        if not 0 <= n < 2**31 or n % every:
            raise DomainError(f"n = {n}: give a multiple of the {every} combinations of the grid, below 2^31" if every > 1 else
                              f"n = {n}: give a number of rows from 1 to 2^31 - 1")
        if design == "saltelli" and not made.block:
            raise DomainError('design = "saltelli": no random number varies')
        if design == "saltelli" and n // every % made.block:
            raise DomainError(f"n = {n}: for the design saltelli give a multiple of {every * made.block}, {made.block} rows for each of its points, which are "
                              "best as many as a power of two")
        if made.block and design == "sobol" and n > (most := MOST_SOBOL * every):
            raise DomainError(f'n = {n}: a Sobol sequence has 2^30 points; give at most {most} rows, or design = "random"')
        if made.block and design == "latin-hypercube" and n > (most := MOST_LATIN // (made.block - 2) * every):
            raise DomainError(f'n = {n}: a Latin hypercube is made as a whole, whatever the shard; give at most {most} rows, or design = "sobol" or "random"')
        return made

    @cached_property
    def _axes(self) -> dict[str, tuple[Axis, Floats]]:
        return {key: (each, each.ends(self.readers[key])) for key, each in self.vary.items() if isinstance(each, Axis)}

    @cached_property
    def _cases(self) -> dict[str, Floats]:
        made = {}
        for key, values in self.cases.items():
            with told_of(key):
                made[key] = np.array([self.readers[key](value) for value in values])
        return made

    @cached_property
    def _quantiles(self) -> dict[str, Callable[[Floats], Floats]]:
        return {key: each.quantiles(self.readers[key]) for key, each in self.vary.items() if isinstance(each, Spread)}

    @property
    def _shape(self) -> tuple[int, ...]:
        """Lengths of the table of cases, where there is one, and of the axes of the grid; the last runs fastest."""
        return (*{len(values) for values in self.cases.values()}, *(len(each) for each, _ in self._axes.values()))

    @property
    def block(self) -> int:
        """Rows that a point of the design saltelli has: A, B, and of each random number A with that number from B."""
        random = sum(isinstance(each, Spread) for each in self.vary.values())
        return random + 2 if random else 0

    def columns(self, rows: range) -> dict[str, Floats]:
        """The values of these rows, by key: (len(rows),) each."""
        made: dict[str, Floats] = {}
        shape = self._shape
        if shape:
            places = np.unravel_index(np.arange(rows.start, rows.stop) % math.prod(shape), shape)
            made |= {key: values[places[0]] for key, values in self._cases.items()}
            of_axes = zip(self._axes.items(), places[len(places) - len(self._axes):], strict=True)
            made |= {key: axis.at(place, ends) for (key, (axis, ends)), place in of_axes}
        shares = self._shares(rows)
        with np.errstate(over="ignore"):  # a row whose number is infinite says so
            made |= {key: np.ascontiguousarray(quantile(shares[key])) for key, quantile in self._quantiles.items()}
        return {key: made[key] for key in (*self.cases, *self.vary)}

    def _shares(self, rows: range) -> dict[str, Floats]:
        """Shares of the probability, in (0, 1), of the random numbers in these rows."""
        names = sorted(self._quantiles)  # of the columns of a design, whatever order they were named in
        if self.design == "random" or not names:
            return {name: _draws(self.seed, name, rows) for name in names}
        every = math.prod(self._shape)
        # each combination of the grid gets the same points of the design
        first, last = rows.start // every, (rows.stop - 1) // every + 1
        if self.design == "saltelli":
            return self._saltelli(names, np.arange(rows.start, rows.stop) // every, range(first // self.block, (last - 1) // self.block + 1))
        points = (self._sobol if self.design == "sobol" else self._latin)(len(names), first, last)
        shown = np.ascontiguousarray(points[np.arange(rows.start, rows.stop) // every - first].T)
        return dict(zip(names, shown, strict=True))

    def _sobol(self, width: int, first: int, last: int) -> Floats:
        engine = _qmc().Sobol(width, scramble=True, seed=np.random.default_rng(self.seed))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of numbers that are no powers of two
            if first:
                engine.fast_forward(first)
            points: Floats = engine.random(last - first) + 2.0**-31  # of multiples of 2^-30 the middles
        return points

    def _saltelli(self, names: list[str], places: NDArray[np.int64], bases: range) -> dict[str, Floats]:
        """Of each point of a Sobol sequence two halves, A and B, and these mixed: Saltelli et al. (2010), doi:10.1016/j.cpc.2009.09.018."""
        width, member = len(names), places % self.block
        points = self._sobol(2 * width, bases.start, bases.stop)[places // self.block - bases.start]
        return {name: np.where((member == 1) | (member == 2 + i), points[:, width + i], points[:, i]) for i, name in enumerate(names)}

    @cached_property
    def _hypercube(self) -> Floats:
        count = self.n // math.prod(self._shape)
        points: Floats = _qmc().LatinHypercube(len(self._quantiles), seed=np.random.default_rng(self.seed)).random(count)
        return np.clip(points, 2.0**-54, 1 - 2.0**-53)

    def _latin(self, _: int, first: int, last: int) -> Floats:
        return self._hypercube[first:last]

    def told(self) -> dict[str, Any]:
        """The plan as plain data, by which two parts of one study know each other."""
        digest = hashlib.sha256(b"".join(values.tobytes() for values in self._cases.values())).hexdigest()
        return {"vary": {key: str(each) for key, each in self.vary.items()}, "cases": {"keys": list(self.cases), "digest": digest} if self.cases else {},
                "n": self.n, "seed": self.seed, "design": self.design}


def _qmc() -> Any:
    try:
        from scipy.stats import qmc
    except ImportError as error:
        raise ImportError("scipy is not installed: pip install 'gyrostat[xarray]'") from error
    return qmc
