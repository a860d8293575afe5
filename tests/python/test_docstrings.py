"""What the documentation says of every public function: shapes of arrays, what is refused; on lines that fit a screen."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import derham
from derham.spaces import FormSpace, Refinement

CLASSES = (derham.Complex, FormSpace, Refinement, derham.SimplicialMap)
#: Arrays and matrices, but no containers of them.
ARRAYS = re.compile(r"Floats|Integers|npt\.NDArray|sparse\.")


def documented() -> Iterator[tuple[str, Any]]:
    """All that is public, by name: functions, classes, methods, properties."""
    for name in derham.__all__:
        thing = getattr(derham, name)
        if callable(thing) and not (inspect.isclass(thing) and issubclass(thing, Exception)):
            yield name, thing
    for class_ in CLASSES:
        for name in dir(class_):
            if not name.startswith("_"):
                thing = inspect.getattr_static(class_, name)
                yield f"{class_.__name__}.{name}", thing.fget if isinstance(thing, property) else thing
    for name, thing in inspect.getmembers(derham.generate, inspect.isfunction):
        if thing.__module__ == "derham.generate" and not name.startswith("_"):
            yield f"generate.{name}", thing


DOCUMENTED = dict(documented())
FUNCTIONS = {name: thing for name, thing in DOCUMENTED.items() if inspect.isfunction(thing)}


@pytest.mark.parametrize("name", DOCUMENTED)
def test_everything_is_documented(name: str) -> None:
    assert inspect.getdoc(DOCUMENTED[name])


def arguments(function: Callable[..., Any]) -> list[str]:
    return [name for name in inspect.signature(function).parameters if name not in ("self", "cls")]


@pytest.mark.parametrize("name", [name for name, function in FUNCTIONS.items() if arguments(function)])
def test_what_is_refused_is_said(name: str) -> None:
    """Of all generators, at the head of their module."""
    text = derham.generate.__doc__ if name.startswith("generate.") else FUNCTIONS[name].__doc__
    assert text and re.search(r"\bRaises\b", text)


@pytest.mark.parametrize(
    "name", [name for name, f in FUNCTIONS.items() if ARRAYS.match(str(f.__annotations__.get("return", "")))]
)
def test_shapes_are_said(name: str) -> None:
    assert "shape" in (FUNCTIONS[name].__doc__ or "").lower() or name == "Complex.one_sided"


def test_lines_of_the_source_fit() -> None:
    package = Path(derham.__file__).parent
    long = [
        (path.name, number)
        for path in sorted([*package.glob("*.py"), *Path(__file__).parent.glob("*.py")])
        for number, line in enumerate(path.read_text().splitlines(), 1)
        if len(line) > 130
    ]
    assert long == []
