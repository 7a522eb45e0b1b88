import pytest

from cadlab.markdown import put, table


def test_a_table_has_a_head_a_rule_and_a_line_for_each_row():
    assert table(("", "n"), [("a", 1), ("b", "")]) == ["|  | n |", "|---|---|", "| a | 1 |", "| b |  |"]


def test_numbers_stand_at_the_right_of_the_first_column():
    assert table(("a", "b", "c"), [], numbers=True) == ["| a | b | c |", "|:---|---:|---:|"]


def test_a_text_takes_the_place_between_its_marks():
    page = "a\n<!-- x: begin -->\nold\n<!-- x: end -->\nb\n"
    written = put(page, "x", "new")
    assert written == "a\n<!-- x: begin -->\nnew\n<!-- x: end -->\nb\n"
    assert put(written, "x", "new") == written


@pytest.mark.parametrize("page", ["", "<!-- x: begin -->", "<!-- x: end -->"])
def test_a_page_without_the_marks_is_refused(page):
    with pytest.raises(ValueError, match="no place called 'x'"):
        put(page, "x", "new")
