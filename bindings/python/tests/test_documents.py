"""What the documentation promises: examples run, the tutorial runs, ``python -m tautline`` writes a picture."""

import ast
import doctest
import re
import subprocess
import sys
from pathlib import Path
from typing import List

import pytest

import tautline as tl

PACKAGE = Path(__file__).resolve().parents[1]
EXAMPLES = sorted((PACKAGE / "examples").glob("*.py"))


def run(arguments: List[str], folder: Path) -> str:
    """What a Python program prints, which has to succeed."""
    done = subprocess.run([sys.executable, *arguments], cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs_and_what_it_asserts_holds(example: Path, tmp_path: Path) -> None:
    if example.stem.startswith("dask"):
        pytest.importorskip("distributed")
        pytest.importorskip("pandas")
    if example.stem in ("paper_chart", "flag"):
        pytest.importorskip("matplotlib")
    if example.stem.startswith("drape"):
        pytest.importorskip("pxr")
    assert run([str(example), str(tmp_path)], tmp_path)


def test_there_are_eight_examples_and_the_readme_names_them() -> None:
    text = (PACKAGE / "README.md").read_text(encoding="utf-8")
    assert len(EXAMPLES) >= 8
    assert all(f"examples/{example.name}" in text for example in EXAMPLES)


def test_the_tutorial_runs(tmp_path: Path) -> None:
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    import nbformat

    notebook = nbformat.read(PACKAGE / "tutorial.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "it is kept without outputs"
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    shown = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert any("<iframe" in output.get("data", {}).get("text/html", "") for output in shown)
    assert any("image/png" in output.get("data", {}) for output in shown), "the figures"
    assert not any(output["output_type"] == "error" for output in shown)


def test_the_readmes_programs_run(tmp_path: Path) -> None:
    texts = [(folder / "README.md").read_text(encoding="utf-8") for folder in (PACKAGE, PACKAGE.parents[1])]
    programs = re.findall(r"```python\n(.*?)```", "".join(texts), flags=re.DOTALL)
    assert len(programs) == 3
    for program in programs:
        run(["-c", program], tmp_path)


def test_the_package_writes_a_picture(tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    told = run(["-m", "tautline", "icosahedra", "--set", "n=10", "--seconds", "1"], tmp_path)
    assert "60 steps" in told and "wrote icosahedra.png" in told
    with image.open(tmp_path / "icosahedra.png") as picture:
        assert picture.size == (640, 480)
        assert len(picture.getcolors(1 << 20)) > 1000, "there is something to see"


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (["no-scene"], "there is no scene named"),
        (["tower", "--out", "a.bla"], "must be one of .gif"),
        (["tower", "--set", "n=two"], "--set n=two: expected NAME=NUMBER"),
        (["tower", "--set", "m=2"], 'no parameter named "m"'),
        (["a.json", "--set", "n=2"], "a file has none"),
        (["a.json"], "a.json"),
    ],
)
def test_the_package_refuses_in_one_line(arguments: List[str], problem: str, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "tautline", *arguments]
    refused = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert refused.returncode == 1 and problem in refused.stderr and len(refused.stderr.splitlines()) == 1


def test_the_modules_own_example() -> None:
    assert doctest.testmod(tl).failed == 0


def test_what_help_says_is_what_the_stubs_say() -> None:
    stubs = ast.parse((Path(tl.__file__).parent / "_engine.pyi").read_text(encoding="utf-8"))
    for node in stubs.body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and not node.name.startswith("_") and ast.get_docstring(node):
            compare(getattr(tl._engine, node.name), node, node.name)
        for member in node.body if isinstance(node, ast.ClassDef) else []:
            if isinstance(member, ast.FunctionDef) and not member.name.startswith("_") and ast.get_docstring(member):
                compare(getattr(getattr(tl._engine, node.name), member.name), member, f"{node.name}.{member.name}")


def compare(thing: object, node: "ast.ClassDef | ast.FunctionDef", name: str) -> None:
    """Of a class, a method or a property."""
    assert " ".join((thing.__doc__ or "").split()) == " ".join((ast.get_docstring(node) or "").split()), name
