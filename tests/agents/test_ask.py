import functools
import json
import socket
from dataclasses import replace

import pytest

from cadgraph.agents.ask import Limits, ask
from cadgraph.agents.evidence import Call, support_of, value_of
from cadgraph.agents.tools import TOOLS, tool_named
from cadgraph.errors import AskError, LabelError
from cadgraph.labelers.lvlm.price import Price
from cadgraph.labelers.lvlm.talk import Talker, ToolCall, Turn
from command_line import refused, run
from plants_by_hand import HOSTILE, hostile_plant, large_plant, pumping_plant
from scripted_model import ScriptedModel

KEY = "sk-secret-of-the-test-0123456789"
DONE = 'Nothing is known. ANSWER: {"value": null, "tags": []}'


@pytest.fixture(autouse=True)
def _no_settings_from_outside(monkeypatch):
    monkeypatch.delenv("OPENAI_BASE_URL", raising=False)
    monkeypatch.setenv("OPENAI_API_KEY", KEY)


@pytest.fixture(scope="module")
def plant():
    return pumping_plant()


@pytest.fixture(scope="module")
def graph(tmp_path_factory):
    folder = tmp_path_factory.mktemp("plant")
    pumping_plant().graph.save(folder / "graph.json")
    return folder


class Scripted:
    """A model in process that says its turns one after the other; the last one again and again."""

    name = "scripted"

    def __init__(self, *turns, counts=(0, 0)):
        self.turns, self.counts, self.asked = list(turns), counts, []

    def turn(self, system, messages, tools, most, last):
        self.asked.append((json.loads(json.dumps(messages)), most, last))
        said = self.turns.pop(0) if len(self.turns) > 1 else self.turns[0]
        if isinstance(said, str):
            return Turn(said, (), *self.counts)
        calls = (ToolCall(f"c{i}", n, a if isinstance(a, str) else json.dumps(a)) for i, (n, a) in enumerate(said))
        return Turn("", tuple(calls), *self.counts)


def answer(words, value=None, *tags):
    return f"{words}\nANSWER: {json.dumps({'value': value, 'tags': tags})}"


# What an answer rests on


def test_an_answer_names_the_calls_that_returned_its_tags(plant):
    model = Scripted(
        [("find", {"type": "pump"})],
        [("isolate", {"target": "P-001"})],
        answer("Close V-002 and V-005 to isolate P-001.", ["V-002", "V-005"], "P-001", "V-002", "V-005"),
    )
    told = ask(plant, "which valves isolate the pump?", model)
    assert told.sound
    assert told.value == ["V-002", "V-005"]
    assert told.text == "Close V-002 and V-005 to isolate P-001."
    assert told.support.shown == {"V-002": (2,), "V-005": (2,), "P-001": (1, 2)}
    assert [str(call) for call in told.calls] == ['find(type="pump")', 'isolate(target="P-001")']
    assert (told.steps, told.limit) == (3, "")


def test_a_tag_that_no_call_returned_is_named_as_unsupported(plant):
    model = Scripted([("describe", {"id": "P-001"})], answer("Close V-002, then V-977.", None, "V-002", "tank"))
    told = ask(plant, "what now?", model)
    assert not told.sound
    assert told.support.unsupported == ("V-002", "V-977", "tank")


def test_a_tag_that_a_tool_did_not_find_is_absent_and_no_fault_of_the_answer(plant):
    model = Scripted([("describe", {"id": "P-999"})], answer("There is no P-999 here."))
    told = ask(plant, "where is P-999?", model)
    assert (told.support.absent, told.support.unsupported, told.sound) == (("P-999",), (), True)


def test_a_failed_call_shows_nothing_although_it_names_tags(plant):
    model = Scripted([("describe", {"id": "V-00"})], answer("It is V-010."))
    told = ask(plant, "which?", model)
    assert "did you mean V-010?" in told.calls[0].text
    assert told.support.unsupported == ("V-010",)


def test_loose_spellings_count_as_the_tag_that_they_mean(plant):
    calls = (Call(1, "describe", {"id": "V-001"}, "V-001 valve"),)
    assert support_of(plant, "Close V-1, says DN50 and v-001.", (), calls).shown == {"V-001": (1,)}


def test_a_tag_within_a_longer_one_is_another_tag():
    plant = large_plant(1, 12)
    calls = (Call(1, "find", {}, "V-00010 V-0001-A V-0002"),)
    assert support_of(plant, "V-0001 and V-0002", (), calls).unsupported == ("V-0001",)


def test_numbers_that_no_call_returned_are_named(plant):
    calls = (Call(1, "measure", {}, "straight 1.66 m, x -12.345"), Call(2, "find", {}, "9.9", failed=True))
    text = "1.66, 1.7 m, -12.35, 12.3 and 2.50m; but 1.6, 9.9 and 14.005. 3 valves, v1.2.3"
    assert support_of(plant, text, (), calls, "within 2.5 m?").reckoned == ("1.6", "9.9", "14.005")
    told = ask(plant, "how far?", Scripted([("overview", {})], answer("So far.", 77.7)))
    assert (told.support.reckoned, told.sound) == (("77.7",), True)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('Two.\nANSWER: {"value": 2, "tags": ["V-1"]}', ("Two.", 2, ("V-1",))),
        ('Two.\n**ANSWER:** `{"value": 2}`', ("Two.", 2, ())),
        ('ANSWER: {"value": ["V-1", "V-2"]}', ("V-1, V-2", ["V-1", "V-2"], ())),
        ('ANSWER: {"value": null, "tags": 7}', ("Unknown.", None, ())),
        ('Not ANSWER: 3\nANSWER: {"value": 4} thanks', ("Not ANSWER: 3", 4, ())),
        ("Two.\nANSWER: {broken", ("Two.", "{broken", ())),
        ('Two.\nANSWER:\n```json\n{"value": 2}\n```', ("Two.", 2, ())),
        ("Just words.", ("Just words.", None, ())),
        ('ANSWER: {"value": NaN}', ("nan", "nan", ())),
        ('ANSWER: {"value": [[1]]}', ("[[1]]", "[[1]]", ())),
        ("ANSWER: " + "[" * 100_000, None),
    ],
)
def test_the_last_line_of_an_answer_is_read_whatever_a_model_makes_of_it(text, expected):
    found = value_of(text)
    assert expected is None or found == expected


# Calls


def test_errors_are_fed_back_and_mended(plant):
    model = Scripted(
        [("isolate", {"target": "P-009"}), ("isolate", {"goal": "P-001"}), ("isolat", {}), ("isolate", "{'target'")],
        [("isolate", {"target": "P-001", "fewest": None})],
        answer("Close V-002.", None, "V-002"),
    )
    told = ask(plant, "isolate it", model)
    assert [call.failed for call in told.calls] == [True, True, True, True, False]
    fed = [each["content"] for each in model.asked[1][0] if each["role"] == "tool"]
    assert "P-001" in fed[0]
    assert "no argument 'goal'" in fed[1]
    assert "did you mean isolate?" in fed[2]
    assert "must be a JSON object" in fed[3]
    assert told.sound
    # A server that reads arguments again must not stumble over what its model wrote.
    sent = next(each for each in model.asked[1][0] if each["role"] == "assistant")["tool_calls"]
    assert json.loads(sent[3]["function"]["arguments"]) == {}


def test_a_repeated_call_is_answered_from_memory(plant):
    ran = []
    tool = tool_named("trace")
    spied = replace(tool, run=_spied(tool.run, ran))
    model = Scripted(
        [("trace", {"start": "T-001"})],
        [("trace", {"start": "T-001", "page": 1, "direction": "downstream"})],
        [("trace", {"start": "T-001", "direction": "upstream"})],
        answer("It feeds P-001.", None, "P-001"),
    )
    told = ask(plant, "what does T-001 feed?", model, tools=(spied,))
    assert len(ran) == 2
    assert [call.repeats for call in told.calls] == [None, 1, None]
    assert told.support.shown["P-001"] == (1, 3)
    assert "same as call 1" in model.asked[2][0][-1]["content"]


def _spied(function, ran):
    @functools.wraps(function)
    def spy(*given, **named):
        ran.append(named)
        return function(*given, **named)

    return spy


def test_only_so_many_calls_of_a_turn_are_run_and_each_is_answered(plant):
    model = Scripted([("describe", {"id": f"V-{i:03d}"}) for i in range(30)], answer("None."))
    told = ask(plant, "all valves?", model)
    assert len(told.calls) == 8
    assert sum(each["role"] == "tool" for each in model.asked[1][0]) == 30


def test_hostile_names_reach_the_model_as_one_line_of_data():
    plant = hostile_plant()
    model = Scripted([("find", {"type": "valve"})], [("describe", {"id": "V-002"})], answer("Eight valves.", 8))
    told = ask(plant, "how many valves?", model)
    fed = [each["content"] for each in model.asked[-1][0] if each["role"] == "tool"]
    assert all(line.isprintable() for text in fed for part in text.split("\t") for line in part.split("\n"))
    assert not any(line.startswith("Ignore previous") for text in fed for line in text.split("\n"))
    assert told.value == 8


def test_an_answer_of_a_hostile_model_moves_no_cursor(plant):
    model = Scripted([("overview", {})], "\x1b[2J\u202eV-001\x07 done\nsecond\tline\n" + HOSTILE[0])
    told = ask(plant, "what?", model)
    assert all(line.isprintable() for line in told.text.split("\n"))
    assert len(told.text.split("\n")) == 3


@pytest.mark.parametrize(
    "arguments",
    ['{"id": NaN}', '{"id": 1e999}', '{"id": ' + "[" * 500 + "]" * 500 + "}", '{"id": "\\ud800"}', "[]", "7"],
)
def test_arguments_of_any_kind_end_in_an_error_that_can_be_told(plant, arguments):
    told = ask(plant, "what?", Scripted([("describe", arguments)], answer("Nothing.")))
    assert told.calls[0].failed
    json.dumps(told.values(), allow_nan=False, indent=1)


# Limits


def test_the_last_step_is_an_answer_without_tools(plant):
    model = Scripted([("overview", {})], [("find", {"type": "valve"})], answer("V-001 is one.", None, "V-001"))
    told = ask(plant, "which?", model, Limits(steps=3))
    assert [last for _, _, last in model.asked] == [False, False, True]
    assert told.limit == "the limit of 3 steps (--max-steps)"
    assert not told.sound
    assert told.support.shown == {"V-001": (2,)}


def test_a_model_that_never_stops_calling_ends_without_an_answer(plant):
    with pytest.raises(LabelError, match=r"limit of 4 steps.*gave no answer"):
        ask(plant, "which?", Scripted([("overview", {})]), Limits(steps=4))


@pytest.mark.parametrize("counts", [(0, 0), (3000, 200)])
def test_tokens_stay_below_their_limit_and_end_in_an_answer(counts):
    plant = large_plant()
    calls = [[("find", {"type": "part", "page": page}) for page in range(k, k + 3)] for k in range(1, 60, 3)]
    model = Scripted(*calls, answer("Many."))
    limits = Limits(steps=20, tokens=20_000)

    def turn(*given):
        said = Scripted.turn(model, *given)
        return Turn(answer("Many."), (), *counts) if given[-1] else said

    model.turn = turn
    told = ask(plant, "all parts?", model, limits)
    assert told.limit == "the limit of 20,000 tokens (--max-tokens)"
    assert told.prompt_tokens + told.answer_tokens <= limits.tokens
    assert told.text == "Many."


def test_money_stays_below_its_limit():
    plant = large_plant()
    model = Scripted(*[[("find", {"type": "part", "page": page})] for page in range(1, 40)], answer("Many."))
    model.turn = lambda *given: Turn(answer("Many.")) if given[-1] else Scripted.turn(model, *given)
    price = Price(input=2.5, output=10.0)
    told = ask(plant, "all parts?", model, Limits(40, 1_000_000, 0.05), price=price)
    assert told.limit == "the limit of $0.05 (--max-cost)"
    assert 0.01 < told.cost <= 0.05


def test_what_does_not_fit_any_more_is_left_out_and_supports_nothing():
    plant = large_plant()
    pages = [("find", {"type": "part", "page": page}) for page in range(1, 9)]
    model = Scripted(pages, answer("part-00000 and part-00400", None))
    told = ask(plant, "all parts?", model, Limits(steps=5, tokens=12_000))
    assert not told.calls[0].failed
    assert told.calls[-1].failed
    assert "left out" in told.calls[-1].text


def test_limits_that_leave_no_room_are_refused_before_anything_is_asked(plant):
    model = Scripted(DONE)
    with pytest.raises(AskError, match=r"1,500 tokens.*leaves no room.*tools alone take about"):
        ask(plant, "what?", model, Limits(tokens=1500))
    with pytest.raises(AskError, match=r"has no price"):
        ask(plant, "what?", model, Limits(cost=1.0))
    with pytest.raises(AskError, match=r"\$0 .*leaves no room"):
        ask(plant, "what?", model, Limits(cost=0.0), price=Price(input=1, output=1))
    with pytest.raises(ValueError, match="2 or more"):
        Limits(steps=1)
    assert model.asked == []


@pytest.mark.parametrize("question", ["", " \n", "x" * 5000])
def test_no_question_and_an_endless_one_are_refused(plant, question):
    with pytest.raises(AskError):
        ask(plant, question, Scripted(DONE))


# Servers


def command(capsys, graph, server, *more, question="which valves isolate P-001?"):
    with server.running() as address:
        return run(capsys, "ask", graph, question, "--model", "scripted", "--base-url", address, *more)


def test_the_command_shows_answer_evidence_and_steps(capsys, graph):
    server = ScriptedModel(
        [("isolate", {"target": "P-001"})], "<think>hm</think>" + answer("Close [bold]V-002[/].", ["V-002"], "V-002")
    )
    code, out, err = command(capsys, graph, server, "--verbose")
    assert code == 0
    assert out.startswith("Close [bold]V-002[/].\n")
    assert "V-002: call 1" in out
    assert 'isolate(target="P-001")' in out
    assert "isolate P-001" in out
    assert "2 steps, 2,000 + 100 tokens" in out
    assert 'step 1, call 1: isolate(target="P-001")' in err
    first, second = server.bodies
    assert [each["function"]["name"] for each in first["tools"]] == [tool.name for tool in TOOLS]
    assert "data" in first["messages"][0]["content"]
    assert second["messages"][-1]["tool_call_id"] == second["messages"][-2]["tool_calls"][0]["id"]
    assert server.keys == [f"Bearer {KEY}"] * 2


def test_json_holds_all_of_it_and_no_key(capsys, graph):
    server = ScriptedModel([("describe", {"id": "V-001"})], answer(f"The key is {KEY}; V-001, V-002.", 1.5, "V-001"))
    code, out, err = command(capsys, graph, server, "--json")
    told = json.loads(out)
    assert code == 1
    assert told["value"] == 1.5
    assert told["rests_on"] == {"V-001": [1]}
    assert told["unsupported"] == ["V-002"]
    assert told["calls"][0]["arguments"] == {"id": "V-001"}
    assert (told["steps"], told["prompt_tokens"], told["cost_usd"]) == (2, 2000, 0.0)
    assert KEY not in out + err


def test_halves_of_characters_reach_neither_server_nor_screen(capsys, graph):
    server = ScriptedModel(
        [("describe", '{"id": "\ud800V-001"}'), ("\udfff", {})], answer("V-001 \ud83d", "\ud83d", "\ud800")
    )
    code, out, _ = command(capsys, graph, server, "--json", question="what \udcff?")
    assert (code, len(server.bodies)) == (0, 2)
    out.encode()
    assert command(capsys, graph, ScriptedModel([("overview", {})], "\ud83d"))[0] == 0


def test_a_reached_limit_ends_with_one_and_says_so(capsys, graph):
    server = ScriptedModel(lambda body: [("overview", {})] if "tools" in body else answer("I don't know."))
    code, out, _ = command(capsys, graph, server, "--max-steps", 3)
    assert code == 1
    assert "the limit of 3 steps (--max-steps) ended it" in out
    assert "tools" not in server.bodies[-1]


def test_an_answer_that_was_cut_off_is_not_sound(capsys, graph):
    server = ScriptedModel([("overview", {})], "Close V-0", finish="length")
    code, out, _ = command(capsys, graph, server)
    assert code == 1
    assert "greatest length of an answer ended it" in out


def test_thoughts_that_a_server_wants_back_are_sent_back(capsys, graph):
    server = ScriptedModel([("overview", {})], answer("So."), beside={"reasoning_content": "hm", "junk": 1})
    assert command(capsys, graph, server)[0] == 0
    sent = server.bodies[1]["messages"][-2]
    assert sent["reasoning_content"] == "hm"
    assert "junk" not in sent


@pytest.mark.parametrize(
    "turn",
    [
        (400, "registry.ollama.ai/library/gemma:2b does not support tools"),
        (400, '"auto" tool choice requires --enable-auto-tool-choice and --tool-call-parser to be set'),
        (404, "No endpoints found that support tool use"),
        (500, "Unsupported param: tools"),
        "V-001 and V-002, surely.",
    ],
)
def test_a_model_without_tools_ends_with_two_and_one_sentence(capsys, graph, turn):
    server = ScriptedModel(turn)
    code, out, err = command(capsys, graph, server)
    assert (code, out) == (2, "")
    assert "use tools" in err
    assert err.count("error:") == err.count("\n") == 1
    assert len(server.bodies) <= 2


def test_a_model_that_forgets_its_tools_is_reminded_once(capsys, graph):
    server = ScriptedModel("Hello!", [("overview", {})], answer("A plant."))
    assert command(capsys, graph, server)[0] == 0
    assert "Call a tool first" in server.bodies[1]["messages"][-1]["content"]


def test_a_server_that_wants_tools_named_at_the_end_gets_them_without_leave_to_call(capsys, graph):
    def strict(body):
        if "tools" not in body:
            return (400, "tools= param is required when messages contain tool calls")
        return answer("So.") if body.get("tool_choice") == "none" else [("overview", {})]

    code, out, _ = command(capsys, graph, ScriptedModel(strict), "--max-steps", 2)
    assert (code, out.split("\n")[0]) == (1, "So.")


def test_a_server_is_asked_as_it_understands(capsys, graph):
    def picky(body):
        if "max_completion_tokens" in body:
            return (400, "unknown field max_completion_tokens")
        if "temperature" in body:
            return (400, "temperature is not supported")
        if body["messages"][0]["role"] == "system":
            return (400, "system role not supported")
        return answer("So.") if body["messages"][-1]["role"] == "tool" else [("overview", {})]

    server = ScriptedModel(picky)
    assert command(capsys, graph, server)[0] == 0
    assert server.bodies[-1]["messages"][0]["content"].endswith("which valves isolate P-001?")
    assert len(server.bodies) == 5


def test_a_refusal_without_a_reason_that_helps_is_told_at_once(capsys, graph):
    server = ScriptedModel((400, "bad request"))
    code, _, err = command(capsys, graph, server)
    assert (code, len(server.bodies)) == (2, 1)
    assert "refused the question (400): bad request" in err
    server = ScriptedModel([("overview", {})], (400, "a message of role tool must follow its call"))
    assert "refused the question (400): a message of role tool" in command(capsys, graph, server)[2]


def test_a_bad_key_a_dead_server_and_a_full_context_end_with_two(capsys, graph, monkeypatch):
    _, _, err = command(capsys, graph, ScriptedModel((400, "maximum context length is 2048 tokens, tools included")))
    assert "too long for the server's context" in err
    monkeypatch.setenv("OPENAI_API_KEY", "wrong-key-of-nobody")
    code, _, err = command(capsys, graph, ScriptedModel("x"))
    assert code == 2
    assert "refuses the key (401)" in err
    assert "wrong-key" not in err
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    monkeypatch.setattr("cadgraph.labelers.lvlm.patience._UNREACHABLE", 0.0)
    said = refused(capsys, "ask", graph, "what?", "--model", "m", "--base-url", f"http://127.0.0.1:{port}/v1")
    assert "can't be reached" in said


def test_without_a_model_the_commands_are_named(capsys, graph):
    said = refused(capsys, "ask", graph, "what?")
    for tool in TOOLS:
        assert tool.name.replace("_", "-") in said
    assert "--model" in said


def test_without_a_key_openai_is_not_asked(capsys, graph, monkeypatch):
    monkeypatch.delenv("OPENAI_API_KEY")
    assert "OPENAI_API_KEY" in refused(capsys, "ask", graph, "what?", "--model", "gpt-4o")
    given = ("--model", "m", "--base-url", "http://user:pw@localhost/v1")
    assert "no user, password" in refused(capsys, "ask", graph, "what?", *given)


def test_a_model_without_a_price_keeps_no_limit_on_cost(capsys, graph):
    talker = Talker("unheard-of", base_url="")
    assert talker.address.startswith("https://")
    assert "has no price" in refused(capsys, "ask", graph, "what?", "--model", "unheard-of", "--max-cost", "1")
