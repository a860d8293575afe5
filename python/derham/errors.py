"""What derham raises. Each error is also the builtin one that a caller would expect."""

from __future__ import annotations

import errno
import os
from typing import Any


class Error(Exception):
    """The root of everything that derham raises."""


class InputError(Error, ValueError):
    """An argument has a wrong shape, range or value. `row` is the first offending row of the input, or -1."""

    def __init__(self, message: str, row: int = -1) -> None:
        super().__init__(message)
        self.row = row


class TopologyError(Error, ValueError):
    """A complex lacks a topological property that was demanded: purity, manifold, orientability."""


class GeometryError(Error, ValueError):
    """A metric quantity does not exist: no metric, a flat simplex, a position that is not finite, a zero dual volume."""


class LimitError(Error, OverflowError):
    """Something does not fit: the index type, or a stated bound on size."""


class FileError(Error, OSError):
    """A file cannot be read, parsed or written. `line` is 0 where no line applies; `action` is "read" or "write".

    Where the system refused, `errno` is its number, and the error is also the builtin one of that number, as those of `open`:
    FileNotFoundError, PermissionError, IsADirectoryError, ….
    """

    path: str
    line: int
    action: str

    def __new__(cls, message: str, path: str = "", line: int = 0, action: str = "read") -> FileError:
        number = None if line else _number_of(message)
        builtin = type(OSError(number, "")) if number else OSError
        self = super().__new__(_both(cls, builtin), message)
        self.errno, self.filename = number, path or None
        self.strerror = os.strerror(number) if number else None
        self.path, self.line, self.action = path, line, action
        return self

    def __init__(self, message: str, path: str = "", line: int = 0, action: str = "read") -> None:
        pass

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[Any, ...]:
        return FileError, (self.args[0], self.path, self.line, self.action)


def _number_of(message: str) -> int | None:
    """The number of the error of the system that a message of the library ends with."""
    reason = message.rpartition(": ")[2]
    return next((number for number in errno.errorcode if os.strerror(number) == reason), None)


_classes: dict[tuple[type[FileError], type[OSError]], type[FileError]] = {}


def _both(cls: type[FileError], builtin: type[OSError]) -> type[FileError]:
    """The class of errors that are both, the same one every time."""
    if issubclass(cls, builtin):
        return cls
    members = {"__module__": cls.__module__, "__doc__": cls.__doc__}
    return _classes.setdefault((cls, builtin), type(cls.__name__, (cls, builtin), members))
