"""Servers that people run at home, each with the manners that it has; messages are as the servers word them."""

import json

import numpy as np
import pytest

from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.answer import Answer, read
from cadgraph.labelers.lvlm.asking import Asking
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.client import Client
from cadgraph.labelers.lvlm.profile import read_profile
from home_server import ANSWER, HomeServer, images_in, question, refused, said, words_in


@pytest.fixture(autouse=True)
def _no_settings_from_outside(monkeypatch):
    monkeypatch.delenv("OPENAI_BASE_URL", raising=False)
    monkeypatch.delenv("OPENAI_API_KEY", raising=False)


def ask(reply, model="m", port=9999, asked=None, **more):
    """What came back, and the server; the profile is that of a server at a port."""
    server = HomeServer(reply)
    profile = read_profile(model, f"http://localhost:{port}/v1", context=more.pop("context", None))
    with server.running() as address:
        client = Client(model, base_url=address, profile=profile, timeout=20, **{"retries": 0} | more)
        try:
            answer = client.ask(asked or question())
            again = client.ask(question("And this?"))
        finally:
            client.close()
    assert (answer.error is None) == (again.error is None)
    return answer, server


def form_of(body):
    return body.get("response_format", {}).get("type", "none")


def flange(reply):
    assert reply.error is None, reply.error
    return read(reply.text, Answer).name == "flange"


def test_vllm_with_one_picture_a_prompt_gets_a_sheet_with_numbers():
    def reply(body, server):
        if len(images_in(body)) > 1:
            return 400, {
                "object": "error", "message": "At most 1 image(s) may be provided in one request.",
                "type": "BadRequestError", "param": None, "code": 400,
            }  # fmt: skip
        return 200, said()

    answer, server = ask(reply, port=8000)
    assert flange(answer)
    # One refusal for the whole run.
    assert [len(images_in(body)) for body in server.bodies] == [6, 1, 1]
    (sheet,) = images_in(server.bodies[-1])
    assert sheet.size == (3 * 512 + 2 * 6, 2 * 512 + 6)
    words = words_in(server.bodies[-1])
    assert all(f"{i}: View {i}" in words for i in range(1, 7))
    # Each tile has its own colour, and its number in a white box.
    pixels = np.asarray(sheet.convert("RGB")).astype(int)
    for i in range(6):
        tile = pixels[i // 3 * 518 :, i % 3 * 518 :][:512, :512]
        assert abs(tile[400, 400] - (40 * i, 90, 200 - 20 * i)).max() < 8
        assert (tile[:80, :80].min(axis=-1) > 230).sum() > 200


def test_a_limit_of_several_pictures_is_kept():
    def reply(body, server):
        if len(images_in(body)) > 4:
            return 400, refused("At most 4 image(s) may be provided in one prompt.")
        return 200, said()

    answer, server = ask(reply)
    assert flange(answer)
    assert [len(images_in(body)) for body in server.bodies] == [6, 3, 3]


def test_vllm_says_that_a_prompt_is_too_long_and_gets_smaller_pictures():
    def reply(body, server):
        used = sum(image.width * image.height for image in images_in(body)) // 784
        if used > 600:
            return 400, refused(
                f"This model's maximum context length is 2048 tokens. However, you requested {used + 1600} tokens "
                "(in the messages and 600 in the completion, max_tokens). Please reduce the length of the messages."
            )
        return 200, said()

    answer, server = ask(reply)
    assert flange(answer)
    assert [images_in(body)[0].width for body in server.bodies] == [512, 384, 256, 256]


def test_what_never_fits_ends_with_the_reason():
    message = "the request exceeds the available context size. try increasing the context size or enable context shift"
    error = {"error": {"code": 400, "message": message, "type": "exceed_context_size_error", "n_ctx": 512}}
    answer, server = ask(lambda body, server: (400, error), port=8080)
    assert "a question with a single picture is too long for the server's context (400)" in answer.error
    assert len(images_in(server.bodies[-1])) == 1
    assert len(server.bodies) <= 8


def test_ollama_cuts_long_prompts_without_a_word_so_only_what_fits_is_sent():
    answer, server = ask(lambda body, server: (200, said()), "qwen2.5vl:7b", 11434, question("word " * 2200))
    assert flange(answer)
    assert [images_in(server.bodies[0])[0].width, len(images_in(server.bodies[0]))] == [256, 6]
    _, server = ask(lambda body, server: (200, said()), "qwen2.5vl:7b", 11434, question("word " * 2700))
    assert len(images_in(server.bodies[0])) == 3
    assert "Only the first 3 of 6 pictures follow." in words_in(server.bodies[0])
    _, server = ask(lambda body, server: (200, said()), "qwen2.5vl:7b", 11434, question("word " * 2200), context=32768)
    assert images_in(server.bodies[0])[0].width == 512


def test_ollama_takes_one_picture_a_message_for_some_models():
    def reply(body, server):
        if len(images_in(body)) > 1:
            return 500, {
                "error": {"message": "vision model only supports a single image per message", "type": "api_error"}
            }
        return 200, said()

    answer, server = ask(reply, "gemma3:4b", 11434)
    assert flange(answer)
    assert max(images_in(server.bodies[-1])[0].size) <= 896
    assert all("max_tokens" in body and "max_completion_tokens" not in body for body in server.bodies)


def test_llama_vision_gets_one_sheet_and_no_system_message_from_the_start():
    answer, server = ask(lambda body, server: (200, said()), "llama3.2-vision:11b", 11434)
    assert flange(answer)
    assert len(server.bodies) == 2
    assert [message["role"] for message in server.bodies[0]["messages"]] == ["user"]
    assert words_in(server.bodies[0]).startswith("Answer in JSON.\n\nWhat is this?")
    (sheet,) = images_in(server.bodies[0])
    assert max(sheet.size) <= 1120


@pytest.mark.parametrize(
    "message",
    [
        "System role not supported",
        "Prompting with images is incompatible with system messages.",
        "Conversation roles must alternate user/assistant/user/assistant/...",
    ],
)
def test_a_server_that_refuses_system_messages_gets_them_before_the_question(message):
    def reply(body, server):
        return (400, refused(message)) if body["messages"][0]["role"] == "system" else (200, said())

    answer, server = ask(reply)
    assert flange(answer)
    assert len(server.bodies) == 3
    assert "Answer in JSON." in words_in(server.bodies[-1])


def test_lm_studio_takes_schemas_and_no_plain_json_objects():
    def reply(body, server):
        if form_of(body) == "json_object":
            return 400, {"error": "'response_format.type' must be 'json_schema' or 'text'"}
        return 200, said()

    answer, server = ask(reply, "google/gemma-3-12b", 1234)
    assert flange(answer)
    assert [form_of(body) for body in server.bodies] == ["json_schema", "json_schema"]


def test_a_server_without_any_form_is_asked_in_words():
    def reply(body, server):
        if form_of(body) != "none":
            return 400, {"error": "'response_format.type' must be 'text'"}
        return 200, said("Sure! Here it is:\n```json\n" + json.dumps(ANSWER, indent=1) + "\n```\nHope this helps {:-)")

    answer, server = ask(reply)
    assert flange(answer)
    assert [form_of(body) for body in server.bodies] == ["json_schema", "json_object", "none", "none"]


def test_llama_cpp_that_cannot_make_a_grammar_of_the_schema_gets_an_object():
    def reply(body, server):
        if form_of(body) == "json_schema":
            return 500, refused("failed to parse grammar", "server_error")
        return 200, said()

    answer, server = ask(reply, port=8080, retries=3)
    assert flange(answer)
    assert [form_of(body) for body in server.bodies] == ["json_schema", "json_object", "json_object"]


def test_the_page_of_a_gateway_that_is_out_of_order_changes_nothing():
    page = b"<html><body>502 Bad Gateway " + b"schema.org temperature system message " * 50 + b"</body></html>"

    def reply(body, server):
        return (502, page, {"retry-after": "0"}) if len(server.bodies) == 1 else (200, said())

    answer, server = ask(reply, retries=1)
    assert flange(answer)
    assert {form_of(body) for body in server.bodies} == {"json_schema"}
    assert all(len(body["messages"]) == 2 and "temperature" in body for body in server.bodies)


@pytest.mark.parametrize(
    "message",
    [
        "image input is not supported - hint: if this is unexpected, you may need to provide the mmproj",
        "At most 0 image(s) may be provided in one prompt.",
        "llama3:8b is not a multimodal model",
        "This model does not support images",
    ],
)
def test_a_model_without_eyes_ends_the_run(message):
    with pytest.raises(LabelError, match="sees no pictures"):
        ask(lambda body, server: (500 if "mmproj" in message else 400, refused(message)), port=8080)


def test_a_server_that_knows_only_the_old_name_of_the_limit_gets_it():
    def reply(body, server):
        if "max_completion_tokens" in body:
            return 400, refused("Unrecognized request argument supplied: max_completion_tokens")
        return 200, said()

    answer, server = ask(reply)
    assert flange(answer)
    assert server.bodies[-1]["max_tokens"] == 600


@pytest.mark.parametrize(
    "text",
    [
        "<think>It is round {like a disc}. A flange? {\"group\": \"Tank\"}</think>\n" + json.dumps(ANSWER),
        "so it is round...</think>" + json.dumps(ANSWER),
        "<thinking>hm</thinking>```json\n" + json.dumps(ANSWER) + "\n```",
        "```\n" + json.dumps(ANSWER) + "\n```",
    ],
)  # fmt: skip
def test_what_a_model_thinks_aloud_and_fences_are_passed_over(text):
    answer, _ = ask(lambda body, server: (200, said(text)))
    assert flange(answer)


@pytest.mark.parametrize("content", [{"choices": []}, {"choices": None}, {}, {"choices": [{}]}])
def test_a_reply_without_choices_is_no_answer_and_asked_for_once_more(content):
    server = HomeServer(lambda body, server: (200, content))
    with server.running() as address:
        client = Client("m", base_url=address, retries=0)
        asking = Asking(client, Cache(":memory:"))
        (outcome,) = asking.ask_all([question()], Answer, lambda asked, reason: question("Once more: what is this?"))
        client.close()
    assert outcome.reason == "no usable answer: it was empty"
    assert len(server.bodies) == 2


@pytest.mark.parametrize("content", [b"", b"<html>", b"[]", b"null", b'"x"', b"\xff\xfe"])
def test_a_reply_that_is_no_object_is_no_answer(content):
    answer, _ = ask(lambda body, server: (200, content, {"content-type": "application/json"}))
    assert answer.error or not answer.text


def test_the_way_that_was_found_is_in_the_record_of_the_run():
    def reply(body, server):
        return (400, refused("response_format is not supported")) if form_of(body) != "none" else (200, said())

    server = HomeServer(reply)
    with server.running() as address:
        client = Client("m", base_url=address)
        asking = Asking(client, Cache(":memory:"))
        asking.ask_all([question()], Answer, lambda asked, reason: asked)
        client.close()
    assert asking.record()["manner"]["schema"] == "none"
