from cadlab.markdown import table


def test_a_table_has_a_head_a_rule_and_a_line_for_each_row():
    assert table(("", "n"), [("a", 1), ("b", "")]) == ["|  | n |", "|---|---|", "| a | 1 |", "| b |  |"]


def test_numbers_stand_at_the_right_of_the_first_column():
    assert table(("a", "b", "c"), [], numbers=True) == ["| a | b | c |", "|:---|---:|---:|"]
