"""The Python programs of README.md and docs run and print what is shown there, and the phrase book has no dead words."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import derham

ROOT = Path(__file__).parents[2]


def printed(program: str, path: str = "page") -> list[str]:
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(program, path, "exec"), {"__name__": "page", "__file__": path})  # noqa: S102
    return out.getvalue().splitlines()


def programs(page: str) -> list[tuple[str, str]]:
    """Every Python program with output below it. What is marked `py` instead is other packages'."""
    return re.findall(r"```python\n((?:(?!```).)*)```\n```text\n(.*?)```", (ROOT / page).read_text(), re.DOTALL)


@pytest.mark.parametrize(("page", "count"), [("docs/python.md", 1), ("docs/coming-from.md", 4)])
def test_page(page: str, count: int) -> None:
    found = programs(page)
    assert len(found) == count == (ROOT / page).read_text().count("```python")
    for program, output in found:
        if "skfem" in program:
            pytest.importorskip("skfem")
        assert printed(program) == output.splitlines()


def test_scikit_fem_prints_the_same() -> None:
    pytest.importorskip("skfem")
    page = (ROOT / "docs/coming-from.md").read_text()
    theirs, = re.findall(r"```py\n(from skfem .*?)```", page, re.DOTALL)
    (_, output), = (pair for pair in programs("docs/coming-from.md") if "skfem" in pair[0])
    assert printed(theirs) == output.splitlines()


def phrases() -> list[str]:
    """The code in the last column of every table of coming-from.md."""
    rows = re.findall(r"^\| .* \| (.*) \|$", (ROOT / "docs/coming-from.md").read_text(), re.MULTILINE)
    return [phrase for row in rows for phrase in re.findall(r"`([^`]+)`", row)]


@pytest.fixture(scope="module")
def words(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What the phrases speak of: a hexagon with a named boundary."""
    K = derham.generate.ball(2, 1)
    edges = K.simplices(1)[K.boundary_simplices()[1]]
    K = K.with_data(parts={"inlet": edges})
    path = tmp_path_factory.mktemp("words") / "hexagon.msh"
    K.write(path)
    w = np.arange(K.size(1)) / 7
    return {
        "derham": derham, "path": path, "K": K, "k": 1, "w": w, "m": 2, "name": "inlet",
        "f": lambda x: np.stack([x[:, 1], -x[:, 0]], axis=1), "points": np.array([[0.1, 0.2], [0.3, 0.1]]),
        "vertices": K.points, "triangles": K.simplices(2), "faces": K.simplices(2), "edges": edges, "lengths": K.volumes(1),
        "kappa": 0.5, "p": K.points.T, "t": K.simplices(2).T, "A": K.star(1, "whitney"), "b": w, "E": K.form_space().extension(1),
        "delta": 1.5, "dimension": 2,
    }


@pytest.mark.parametrize("phrase", phrases())
def test_phrase(phrase: str, words: dict[str, Any]) -> None:
    exec(phrase, dict(words))  # noqa: S102


def test_readme() -> None:
    """The Python program says what the C++ program above it says."""
    text = (ROOT / "README.md").read_text()
    program = re.search(r"```python\n(.*?)```", text, re.DOTALL)
    output = re.search(r"```text\n(.*?)```", text, re.DOTALL)
    assert program and output

    def words(lines: list[str]) -> list[str]:
        return " ".join(lines).lower().replace(",", "").replace("-2.0", "-2").split()

    assert words(printed(program[1])) == words(output[1].splitlines())


def test_tripcolor() -> None:
    """matplotlib takes the arrays as they are, as the page says."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    line, = re.findall(r"`(plt\.tripcolor\(.*?\))`", (ROOT / "docs/python.md").read_text())
    plt = pytest.importorskip("matplotlib.pyplot")
    K = derham.generate.ball(2, 2)
    drawn = eval(line, {"plt": plt, "K": K, "u": K.points[:, 0]})  # noqa: S307
    np.testing.assert_array_equal(drawn.get_array(), K.points[:, 0][K.simplices(2)].mean(axis=1))


@pytest.mark.parametrize("path", sorted((ROOT / "examples" / "python").glob("*.py")), ids=lambda path: path.stem)
def test_example(path: Path) -> None:
    """Examples assert what they print."""
    assert printed(path.read_text(), str(path))
