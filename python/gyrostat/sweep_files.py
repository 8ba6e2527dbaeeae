# SPDX-License-Identifier: BSD-3-Clause
"""The files that hold the results of a sweep: NetCDF, CSV, parquet and zarr."""

import json
import os
import zlib
from collections.abc import Callable, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.errors import DomainError
from gyrostat.facts import FACTS
from gyrostat.writing import written

if TYPE_CHECKING:
    import xarray

__all__ = ["check_size", "checksum", "import_xarray", "open_results", "save", "to_netcdf", "writer_of"]


def import_xarray() -> Any:
    """The module xarray. Raises ImportError, saying what to install."""
    try:
        import xarray
    except ImportError as error:
        raise ImportError("xarray is not installed: pip install 'gyrostat[xarray]'") from error
    return xarray


MOST_BYTES: Final = 2**31  # of a variable of NetCDF 3
LESS: Final = "write .zarr, ask for less (a few columns or scalars, a few times), or take shards and merge them into .zarr"


def _bytes(values: Any) -> int:
    """What a variable takes in a file; words are as long as the longest."""
    return int(values.size * max(map(len, map(str, values.values.flat)), default=0) if values.dtype.kind == "O" else values.nbytes)


def check_size(file: Path, sizes: Mapping[str, int], remedy: str = LESS) -> None:
    """Raise DomainError where variables of these sizes [bytes] are too large for the form of the file's ending: to be asked before long work."""
    if file.suffix.lower() in (".zarr", ".csv", ".parquet"):
        return
    if large := next((name for name, size in sizes.items() if size >= MOST_BYTES), None):
        raise DomainError(f"{file}: {large} would be over 2 GiB, more than a variable of this format holds: {remedy}")


def checksum(dataset: "xarray.Dataset") -> str:
    """Of all values, whatever types a file gives them."""
    total = 0
    for name in sorted(map(str, dataset.variables)):
        values = dataset[name].values
        told = values.astype(np.float64).tobytes() if values.dtype.kind in "biuf" else "\n".join(map(str, values.ravel())).encode()
        total = zlib.crc32(told, total)
    return f"{total:08x}"


def to_netcdf(dataset: "xarray.Dataset", file: Path) -> None:
    """Write NetCDF 3, whatever the ending."""
    dataset.to_netcdf(file, engine="scipy", format="NETCDF3_64BIT")


def _frame(dataset: "xarray.Dataset") -> Any:
    """A pandas.DataFrame with a line a row; components as _x, _y, _z, times as [0], [1] and on."""
    import pandas

    flat: dict[str, Any] = {}
    for name, variable in dataset.data_vars.items():
        labels = [[f"[{i}]" if dim == "time" else f"_{label}" for i, label in enumerate(dataset[dim].values)] for dim in variable.dims[1:]]
        # components before times
        for place in np.ndindex(variable.shape[1:]):
            ends = [labels[axis][i] for axis, i in enumerate(place)]
            values = variable.values[(slice(None), *place)]
            if "flag_values" in variable.attrs:  # numbers that stand for words
                words = dict(enumerate(str(variable.attrs["flag_meanings"]).split()))
                values = np.array([words.get(value, value) for value in values], dtype=object)
            flat[str(name) + "".join(reversed(ends))] = values
    frame = pandas.DataFrame(flat, index=pandas.Index(dataset["row"].values, name="row"))
    frame.attrs.update({key: str(value) for key, value in dataset.attrs.items()})
    return frame


def _to_csv(dataset: "xarray.Dataset", file: Path) -> None:
    _frame(dataset).to_csv(file)


def _to_parquet(dataset: "xarray.Dataset", file: Path) -> None:
    _frame(dataset).to_parquet(file, engine="pyarrow")


def _to_zarr(dataset: "xarray.Dataset", file: Path) -> None:
    dataset.to_zarr(file, mode="w", zarr_format=2)


# By the ending: what writes, the library that it needs, and what installs that.
WRITERS: Final[dict[str, tuple[Callable[["xarray.Dataset", Path], None], str, str]]] = {
    ".nc": (to_netcdf, "scipy", "'gyrostat[xarray]'"), ".csv": (_to_csv, "pandas", "pandas"), ".parquet": (_to_parquet, "pyarrow", "pyarrow"),
    ".zarr": (_to_zarr, "zarr", "zarr")}


def writer_of(file: Path) -> Callable[["xarray.Dataset", Path], None]:
    """What writes in the form of the file's ending. Raises DomainError for an unknown one, ImportError where its library is missing."""
    if file.suffix.lower() not in WRITERS:
        raise DomainError(f"{file}: unknown ending {file.suffix or '(none)'}; use one of {', '.join(WRITERS)}")
    write, library, install = WRITERS[file.suffix.lower()]
    if find_spec(library) is None:
        raise ImportError(f"{library} is not installed: pip install {install}")
    return write


def save(dataset: "xarray.Dataset", file: str | os.PathLike[str]) -> None:
    """Write the results of a sweep: .nc (NetCDF 3), .csv, .parquet (needs pyarrow) or .zarr (needs zarr)."""
    write, path = writer_of(Path(file)), Path(file)
    if path.suffix.lower() == ".zarr":  # a folder
        write(dataset, path)
        return
    check_size(path, {str(name): _bytes(values) for name, values in dataset.variables.items()})
    with written(path) as beside:
        write(dataset, beside)


def open_results(file: str | os.PathLike[str]) -> "xarray.Dataset":
    """Read the results of a sweep from .nc or .zarr. Raises DomainError for what holds none."""
    reader = import_xarray()
    path = Path(file)
    if not path.exists():
        raise DomainError(f"{file}: there is no such file")
    try:
        if path.suffix.lower() == ".zarr":
            found = reader.open_zarr(path).load()
        elif path.suffix.lower() == ".nc":
            found = reader.load_dataset(path, engine="scipy")
        else:
            raise DomainError(f"{file}: results are read from .nc and .zarr")
    except DomainError:
        raise
    except Exception as error:  # of a damaged file the readers raise what they will
        raise DomainError(f"{file}: this cannot be read ({str(error).splitlines()[0] if str(error) else type(error).__name__})") from None
    if "model" in found.attrs and "row" not in found.dims:
        raise DomainError(f"{file}: this holds the answer of one scene, not the rows of a sweep: xarray.open_dataset reads it")
    if not _is_sound(found):
        raise DomainError(f"{file}: this holds no results of a sweep, or they are damaged")
    words = {name: values.astype(object) for name, values in found.data_vars.items() if values.dtype.kind in "UT"}
    made: xarray.Dataset = found.assign(words)[_in_order(found)]
    if made.attrs.pop("checksum", None) not in (None, checksum(made)):
        raise DomainError(f"{file}: bits of this have turned since it was written")
    return made


def _is_sound(dataset: "xarray.Dataset") -> bool:
    """Whether there is all that every sweep has."""
    try:
        study = json.loads(dataset.attrs["study"])
    except (KeyError, TypeError, ValueError):
        return False
    kind, needed = dataset.attrs.get("kind"), ("model", "met", "excess", "warnings", "reason")
    return (isinstance(study, dict) and {"n", "cases", "vary"} <= study.keys() and kind in FACTS and dataset.sizes.get("row", 0) > 0
            and "row" in dataset.coords and all(name in dataset for name in needed))


def _in_order(dataset: "xarray.Dataset") -> list[str]:
    """The names of its variables as a sweep makes them, which not every form of file keeps."""
    study = json.loads(dataset.attrs["study"])
    quantities = (name for each in FACTS[dataset.attrs["kind"]].quantities for name in (each, f"{each}_error"))
    order = (*study["cases"].get("keys", ()), *study["vary"], *quantities, "model", "met", "excess", "warnings", "reason")
    places = {name: i for i, name in enumerate(order)}
    return sorted(map(str, dataset.data_vars), key=lambda name: places.get(name, len(places)))
