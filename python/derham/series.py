"""Pictures over time."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike

from . import _derham
from ._arguments import path_text, real_number, shown
from .errors import InputError


def write_series(path: str | PathLike[str], files: Iterable[tuple[float, str | PathLike[str]]]) -> None:
    """Writes the .pvd file by which ParaView opens many pictures as one that changes with time, complete or not at all.

    files    pairs of a time and the name of a file, as `write_forms` and `write` make them, relative to the place of the
             .pvd file
    Raises   InputError for a time that is not finite or an empty name; FileError if it cannot be written

    >>> import derham
    >>> derham.write_series("/dev/null", [(0.0, "heat_0.vtu"), (0.1, "heat_1.vtu")])
    """
    try:
        pairs = [(time, name) for time, name in files]
    except (TypeError, ValueError):
        raise InputError(f"files is {shown(files)}; expected pairs of a time and the name of a file") from None
    _derham.write_series(path_text(path), [(real_number(time, "the time"), path_text(name)) for time, name in pairs])
