import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.agents.answer import BUDGET, AskError, among, cell, page_of, row, tokens

WORDS = st.text(st.characters(codec="utf-8", exclude_characters="\n"), min_size=0, max_size=60)


def pages(head, rows, foot):
    found = [page_of(head, rows, foot, 1)]
    while "; next: page=" in found[-1].rpartition("\n")[2]:
        found.append(page_of(head, rows, foot, len(found) + 1))
    return found


@given(st.lists(WORDS, max_size=400), st.lists(WORDS, max_size=3), st.lists(WORDS, max_size=3))
def test_pages_keep_within_the_budget_and_lose_and_double_no_row(words, head, foot):
    rows = [f"{number}|{word}" for number, word in enumerate(words)]
    found = pages(head, rows, foot)
    assert all(tokens(text) <= BUDGET for text in found)
    body = []
    for text in found:
        lines = text.split("\n")[: -1 if len(found) > 1 else None]
        assert lines[: len(head)] == head
        assert lines[len(lines) - len(foot) :] == foot
        body += lines[len(head) : len(lines) - len(foot)]
    assert [line for line in body if line or rows] == rows


@given(st.lists(st.integers(1, 9000), max_size=5), st.sampled_from("Zé\U0001d11e"))
def test_rows_longer_than_a_page_go_on_on_the_next(lengths, letter):
    found = pages(["head"], [letter * n for n in lengths], [])
    assert all(tokens(text) <= BUDGET for text in found)
    assert sum(text.count(letter) for text in found) == sum(lengths)


def test_a_head_that_fills_pages_stands_there_once():
    head = [f"head {i} {'x' * 300}" for i in range(20)]
    found = pages(head, ["row"], ["foot"])
    assert all(tokens(text) <= BUDGET for text in found)
    assert sum(text.count("head 19 ") for text in found) == 1
    assert sum(text.count("\nrow") for text in found) == 1


def test_the_last_line_says_what_to_ask_for_next():
    rows = [f"row {i} {'x' * 50}" for i in range(100)]
    assert page_of([], rows, [], 1).endswith("\npage 1 of 3; next: page=2")
    assert page_of([], rows, [], 3).endswith("\npage 3 of 3")
    assert page_of(["all"], ["of it"], [], 1) == "all\nof it"


@pytest.mark.parametrize("page", [0, -1, 4])
def test_a_page_that_is_not_there_is_refused(page):
    with pytest.raises(AskError, match=rf"there is no page {page}; this answer has 3 pages"):
        page_of([], [f"row {i} {'x' * 50}" for i in range(100)], [], page)


@given(st.text(max_size=300))
def test_a_cell_is_one_line_that_can_be_printed(text):
    told = cell(text)
    assert told.isprintable()
    assert len(told) <= 80
    assert cell(told) == told


def test_cells_drop_what_moves_the_cursor_or_turns_the_text_round():
    assert cell("V-1\n\tx\x1b[2J\u202e\u200b\x9b y") == "V-1 x [2J y"
    assert cell("V" * 81) == "V" * 79 + "…"
    assert cell(None) == ""
    assert row("a\tb", "", None, "c", "") == "a b\t\t\tc"


def test_a_word_is_known_whatever_its_capitals_and_else_the_nearest_are_named():
    assert among("Out-of_reach", ["floor", "out of reach"], "reach") == "out of reach"
    with pytest.raises(AskError, match=r"no type 'vlave' here; did you mean valve\?"):
        among("vlave", ["valve", "tank"], "type")
    with pytest.raises(AskError, match=r"no type 'x' here; there is valve, tank"):
        among("x", ["valve", "tank"], "type")
