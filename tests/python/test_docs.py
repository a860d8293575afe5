"""The Python programs of README.md and docs run and print what is shown there."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def printed(program: str, path: str = "page") -> list[str]:
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(program, path, "exec"), {"__name__": "page", "__file__": path})  # noqa: S102
    return out.getvalue().splitlines()


@pytest.mark.parametrize("page", ["docs/python.md"])
def test_page(page: str) -> None:
    found = re.findall(r"```python\n(.*?)```\n```text\n(.*?)```", (ROOT / page).read_text(), re.DOTALL)
    assert found
    for program, output in found:
        assert printed(program) == output.splitlines()


def test_readme() -> None:
    """The Python program says what the C++ program above it says."""
    text = (ROOT / "README.md").read_text()
    program = re.search(r"```python\n(.*?)```", text, re.DOTALL)
    output = re.search(r"```text\n(.*?)```", text, re.DOTALL)
    assert program and output

    def words(lines: list[str]) -> list[str]:
        return " ".join(lines).lower().replace(",", "").replace("-2.0", "-2").split()

    assert words(printed(program[1])) == words(output[1].splitlines())


@pytest.mark.parametrize("path", sorted((ROOT / "examples" / "python").glob("*.py")), ids=lambda path: path.stem)
def test_example(path: Path) -> None:
    """Examples assert what they print."""
    assert printed(path.read_text(), str(path))
