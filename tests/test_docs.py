import ast
import importlib.util
import re
from pathlib import Path

import pytest

from cadgraph.export.dexpi import reader
from cadgraph.load.losses import LOST_GEOMETRY
from cadgraph.model.edits import LOST
from cadgraph.model.mechanisms import NOT_MOVABLE
from cadgraph.query.network import DRAWN_FROM_DOUBT

TOOL = Path(__file__).parents[1] / "tools" / "write_docs.py"


@pytest.fixture(scope="module")
def write_docs():
    spec = importlib.util.spec_from_file_location("write_docs", TOOL)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_generated_documents_are_up_to_date(write_docs):
    assert write_docs.stale(write_docs.DOCS) == [], "run: python tools/write_docs.py"


@pytest.mark.slow
def test_missing_and_changed_documents_are_stale_until_written(write_docs, tmp_path, capsys):
    assert write_docs.main(["--check"], tmp_path) == 1
    assert "graph.schema.json is out of date" in capsys.readouterr().out
    assert list(tmp_path.iterdir()) == []
    assert write_docs.main([], tmp_path) == 0
    assert write_docs.main(["--check"], tmp_path) == 0
    (tmp_path / "graph.schema.json").write_text("{}", encoding="utf-8")
    assert write_docs.main(["--check"], tmp_path) == 1


def test_a_page_by_hand_is_stale_when_a_table_of_it_is_and_keeps_its_own_text(write_docs, tmp_path):
    page = (write_docs.DOCS / "functional.md").read_text(encoding="utf-8")
    (tmp_path / "functional.md").write_text(page.replace("| gap | a gap of", "| gap | a hole of"), encoding="utf-8")
    assert "functional.md" in write_docs.stale(tmp_path)
    assert write_docs.main([], tmp_path) == 0
    assert (tmp_path / "functional.md").read_text(encoding="utf-8") == page


SOURCE = TOOL.parents[1] / "src" / "cadgraph"
CODE = re.compile(r"[a-z]+(?:-[a-z]+)*")
NOTING = {"Diagnostic", "add", "note", "leave_out", "_contradictions"}


def texts_of(node):
    """The constant texts among the arguments of what may make a diagnostic, its code among them."""
    if isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in NOTING:
        return node.args
    if isinstance(node, ast.Tuple) and len(node.elts) > 1:
        # A code before its message.
        first, second = node.elts[:2]
        said = second.values[0] if isinstance(second, ast.JoinedStr) and second.values else second
        return [first] if " " in str(getattr(said, "value", "")) else []
    if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") in ("code", "_BROKEN"):
        chosen = node.value
        return [chosen.body, chosen.orelse] if isinstance(chosen, ast.IfExp) else [chosen]
    if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Subscript):
        return [node.slice] if getattr(node.value.value, "id", "") == "faults" else []
    return []


def codes_of_diagnostics():
    """The codes that the source gives to diagnostics."""
    found = {LOST, NOT_MOVABLE, DRAWN_FROM_DOUBT, *(f"dexpi-{code}" for code in reader._SKIPPED), *LOST_GEOMETRY}
    for path in sorted(SOURCE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            plain = {str(text.value) for text in texts_of(node) if isinstance(text, ast.Constant)}
            found |= {text for text in plain if "-" in text and CODE.fullmatch(text)}
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Diagnostic" and plain:
                found |= {str(text.value) for text in node.args[:1] if isinstance(text, ast.Constant)}
    return found


def test_every_code_of_a_diagnostic_is_described_in_the_format():
    page = (TOOL.parents[1] / "docs" / "format.md").read_text(encoding="utf-8")
    described = set(re.findall(r"`([a-z-]+)`", page[page.index("## Diagnostics") : page.index("## Counts and names")]))
    codes = codes_of_diagnostics()
    assert {"several-bodies", "weak-bridge", "missing-payload", "twisted-faces", "excluded"} <= codes
    assert codes - described == set()
