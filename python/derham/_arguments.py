"""What callers give: arrays, numbers, names and paths, checked and as the compiled half takes them.

Each function names the argument in its InputError, says what it is and what was expected.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _derham
from .errors import InputError

Floats: TypeAlias = npt.NDArray[np.float64]
#: Indices: of 64 bits in a build with DERHAM_INDEX64, but that is not the type checker's business.
Integers: TypeAlias = npt.NDArray[np.int32]

#: The type of indices of simplices and vertices.
index_dtype: np.dtype[Any] = np.dtype(np.int32 if _derham.index_bits == 32 else np.int64)
index_limits = np.iinfo(index_dtype)


def shown(value: Any) -> str:
    """A value on one line: itself if it is short, else what it is."""
    if isinstance(value, (np.ndarray, np.generic)) and value.ndim:
        return f"an array of {value.dtype} of shape {value.shape}"
    text = repr(value)
    return text if len(text) <= 60 and "\n" not in text else f"a {type(value).__name__}"


def array_of(values: npt.ArrayLike, name: str) -> npt.NDArray[Any]:
    """An array of any type. Masked entries are refused, for nothing here knows how to pass over them."""
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        raise InputError(f"{name} has masked entries; expected a number in every place")
    try:
        return np.asarray(values)
    except (ValueError, TypeError, OverflowError) as error:  # for instance rows of several lengths
        raise InputError(f"{name} makes no array: {error}") from None


def float_array(values: npt.ArrayLike, name: str) -> Floats:
    """Real numbers in C order, of shape (1,) for one number; itself if it is so already."""
    array = array_of(values, name)
    if array.dtype.kind not in "fiub":
        raise InputError(f"{name} is an array of {array.dtype}; expected real numbers")
    return np.ascontiguousarray(array, dtype=np.float64)


def index_array(values: npt.ArrayLike, name: str) -> Integers:
    """Indices in C order, of shape (1,) for one number; itself if it is so already."""
    array = array_of(values, name)
    if array.size == 0 and array.dtype.kind == "f":
        array = array.astype(index_dtype)
    if array.dtype.kind not in "iu":
        raise InputError(f"{name} is an array of {array.dtype}; expected integers")
    if array.dtype.itemsize >= index_dtype.itemsize and array.dtype != index_dtype and array.size:
        low, high = array.min(), array.max()
        if low < index_limits.min or high > index_limits.max:
            wrong = high if high > index_limits.max else low
            raise InputError(f"{name} holds {wrong}; expected {index_limits.min} to {index_limits.max}")
    return np.ascontiguousarray(array, dtype=index_dtype)


def index_list(values: npt.ArrayLike, name: str) -> Integers:
    """As `index_array`, of shape (count,)."""
    array = index_array(values, name)
    if array.ndim != 1:
        raise InputError(f"{name} has shape {array.shape}; expected (count,)")
    return array


def whole_number(value: Any, name: str, low: int, high: int) -> int:
    if isinstance(value, (int, np.integer)) and low <= value <= high:
        return int(value)
    raise InputError(f"{name} is {shown(value)}; expected {low} to {high}")


def real_number(value: Any, name: str) -> float:
    if isinstance(value, (int, float, np.integer, np.floating)):
        return float(value)
    raise InputError(f"{name} is {shown(value)}; expected a real number")


def flag(value: Any, name: str) -> bool:
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise InputError(f"{name} is {shown(value)}; expected True or False")


def one_of(value: Any, names: Sequence[str], what: str) -> None:
    if not isinstance(value, str) or value not in names:
        raise InputError(f"{what} is {shown(value)}; expected {', '.join(names[:-1])} or {names[-1]}")


def signed_dtype(dtype: npt.DTypeLike) -> np.dtype[Any]:
    """The type of the entries ±1 of a matrix: one that has a sign and that scipy computes with."""
    try:
        found = np.dtype(dtype)
    except (TypeError, ValueError):
        raise InputError(f"dtype is {shown(dtype)}; expected a type of numbers") from None
    if found.kind not in "ifc" or found == np.float16:
        raise InputError(
            f"dtype is {found}; the entries 1 and -1 need signed integers, complex numbers or floats, not of 16 bits"
        )
    return found


def utf8_text(text: Any, name: str) -> str:
    try:
        if isinstance(text, str):
            text.encode()
            return text
    except UnicodeEncodeError:
        raise InputError(f"{name} {text!r} is not UTF-8") from None
    raise InputError(f"{name} is {shown(text)}; expected a string")


def path_text(path: str | bytes | os.PathLike[Any]) -> str:
    try:
        text = utf8_text(os.fsdecode(path), "the path")
    except TypeError:
        raise InputError(f"the path is {shown(path)}; expected a string or a path") from None
    if "\0" in text:
        raise InputError(f"the path {path!r} holds a zero character")
    return text


def format_name(format: str | None) -> str | None:
    return None if format is None else utf8_text(format, "the format")
