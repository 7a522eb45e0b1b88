"""What the source file says of a part or a unit, as 'cadgraph explain' tells it."""

import json

import graphs
from cadgraph.model.records import SourceFact
from cadgraph.query.explain import explain, explain_any
from command_line import run


def fact(value="ELBO", key="class", where="att TYPE", **more):
    return SourceFact(key=key, value=value, where=where, **more)


def plant(part_facts=(), unit_facts=()):
    part = graphs.part(0, label=graphs.label(), facts=tuple(part_facts))
    unit = graphs.unit("V-001", "part-0").model_copy(update={"facts": tuple(unit_facts)})
    return graphs.graph((part, graphs.part(1), unit))


def told(graph, which):
    rows = explain_any(graph, which).lines()
    start = [heading for heading, _ in rows].index("file says")
    return [text for _, text in rows[start:]]


def test_a_part_tells_what_the_file_says_of_it_and_where():
    graph = plant([fact(), fact("/30F1I/A1", "spec", "att SPREF")])
    assert told(graph, "part-0") == ["class ELBO (att TYPE)", "spec /30F1I/A1 (att SPREF)"]
    assert "file says" not in dict(explain(graph, "part-1").lines())


def test_a_unit_tells_of_which_node_the_file_says_it():
    graph = plant((), [fact("VALV", path="/SITE/V_1")])
    assert told(graph, "V-001") == ["class VALV (att TYPE, of /SITE/V_1)"]


def test_many_facts_and_long_ones_are_cut_in_words_alone():
    graph = plant([fact(f"{i} {'x' * 300}") for i in range(23)], [fact(str(i)) for i in range(20)])
    rows = told(graph, "part-0")
    assert len(rows) == 21
    assert rows[19].startswith("class 19 xxx")
    assert all(len(row) < 230 for row in rows)
    assert rows[-1] == "and 3 more; --json has them all"
    assert len(told(graph, "V-001")) == 20
    values = json.loads(json.dumps(explain(graph, "part-0").to_json()))
    assert values["facts"][22] == {"key": "class", "value": f"22 {'x' * 300}", "where": "att TYPE"}
    assert len(explain_any(graph, "V-001").to_json()["facts"]) == 20


def test_what_a_file_says_stays_text_on_one_line(tmp_path, capsys):
    plant([fact("[red]a\nb\x1b[31m")], [fact("[/x]", path="/[bold]")]).save(tmp_path)
    _, out, _ = run(capsys, "explain", tmp_path, "part-0")
    assert "file says   class [red]a b [31m (att TYPE)" in out
    assert "class [/x] (att TYPE, of /[bold])" in run(capsys, "explain", tmp_path, "V-001")[1]
    values = json.loads(run(capsys, "explain", tmp_path, "part-0", "--json")[1])
    assert values["facts"] == [{"key": "class", "value": "[red]a\nb\x1b[31m", "where": "att TYPE"}]
