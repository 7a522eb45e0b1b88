import importlib.util
from pathlib import Path

import pytest

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
