"""What is known of models and servers, and whether a question fits."""

import pytest

from cadgraph.config import LvlmConfig
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.asking import Asking
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.folder import DryRun
from cadgraph.labelers.lvlm.manner import LEVELS, Manner
from cadgraph.labelers.lvlm.profile import read_profile
from cadgraph.labelers.lvlm.setup import profile_of
from home_server import question

HERE = "http://localhost:9999/v1"


@pytest.mark.parametrize(
    ("model", "family"),
    [
        ("Qwen/Qwen2.5-VL-7B-Instruct", "Qwen2-VL and Qwen2.5-VL"),
        ("qwen2.5vl:7b", "Qwen2-VL and Qwen2.5-VL"),
        ("qwen2.5-vl-72b-instruct-awq", "Qwen2-VL and Qwen2.5-VL"),
        ("Qwen/Qwen2-VL-2B-Instruct", "Qwen2-VL and Qwen2.5-VL"),
        ("Qwen/Qwen3-VL-8B-Instruct", "Qwen3-VL"),
        ("qwen3-vl:8b", "Qwen3-VL"),
        ("OpenGVLab/InternVL3-8B", "InternVL"),
        ("internvl2_5-8b", "InternVL"),
        ("google/gemma-3-12b-it", "Gemma 3"),
        ("gemma3:12b", "Gemma 3"),
        ("gemma-3-4b-it-Q4_K_M.gguf", "Gemma 3"),
        ("gemma3n:e4b", "Gemma 3n"),
        ("meta-llama/Llama-3.2-11B-Vision-Instruct", "Llama 3.2 Vision"),
        ("llama3.2-vision:11b", "Llama 3.2 Vision"),
        ("llava-hf/llava-1.5-7b-hf", "LLaVA 1.5"),
        ("llava:13b", "LLaVA 1.6"),
        ("llava-hf/llava-onevision-qwen2-7b-ov-hf", "LLaVA-OneVision"),
        ("gpt-4o", ""),
        ("qwen2.5:7b", ""),
        ("llama3.2:3b", ""),
        ("gemma-2-9b-it", ""),
    ],
)
def test_a_model_is_known_by_its_name_without_owner_and_tag(model, family):
    assert read_profile(model, HERE).model == family


def test_what_is_not_known_is_asked_as_before():
    profile = read_profile("gpt-4o", "https://api.openai.com/v1")
    assert profile.manner == Manner()
    assert profile.told == ""
    assert profile.level(10**6, 6, 512, 600) == 0


@pytest.mark.parametrize(
    ("address", "server", "context"),
    [
        ("http://localhost:11434/v1", "Ollama", 4096),
        ("http://10.0.0.7:11434/v1", "Ollama", 4096),
        ("http://localhost:1234/v1", "LM Studio", 4096),
        ("http://localhost:8000/v1", "vLLM", 131072),
        ("http://localhost:8080/v1", "llama.cpp", 131072),
        (HERE, "", 131072),
        ("", "", 131072),
    ],
)
def test_a_server_is_known_by_its_port_and_the_smaller_context_counts(address, server, context):
    profile = read_profile("gemma3:12b", address)
    assert (profile.server, profile.context) == (server, context)
    assert profile.manner.limit == ("max_tokens" if server else "max_completion_tokens")


def test_settings_count_more():
    settings = LvlmConfig(
        model="llama3.2-vision", base_url="http://localhost:11434/v1", context=16384, pictures=4, structured="none"
    )
    profile = profile_of(settings)
    assert (profile.context, profile.manner.pictures, profile.manner.schema) == (16384, 4, "none")


def test_what_is_known_is_told_in_words():
    told = read_profile("llama3.2-vision", "http://localhost:11434/v1").told
    assert told == (
        "taken for Llama 3.2 Vision behind Ollama, a context of 4,096 tokens, one picture a message, at most 1120 px"
    )


@pytest.mark.parametrize(
    ("model", "n", "size", "tokens"),
    [
        ("qwen2.5vl", 1, 512, 19 * 19),
        ("qwen2.5vl", 6, 512, 6 * 19 * 19),
        ("gemma3", 6, 512, 6 * 256),
        ("internvl3", 6, 512, 6 * 256),
        ("internvl3", 1, 1024, 10 * 256),
        ("llava:7b", 6, 512, 2880),
        ("gpt-4o", 6, 512, 0),
    ],
)
def test_pictures_are_counted_as_the_model_does(model, n, size, tokens):
    assert read_profile(model, HERE).picture_tokens(n, size) == tokens


def test_pictures_are_shrunk_and_then_left_out_until_the_question_fits():
    profile = read_profile("qwen2.5vl", "http://localhost:11434/v1")
    room = [
        (words, level)
        for words in range(0, 4096, 8)
        for level in [profile.level(words, 6, 512, 600)]
    ]  # fmt: skip
    assert [level for _, level in room] == sorted(level for _, level in room)
    assert {level for _, level in room} == set(range(len(LEVELS)))
    for words, level in room:
        used = words + profile.picture_tokens(6, 512, Manner(level=level)) + 600
        assert used <= 0.95 * 4096 or level == len(LEVELS) - 1


def test_a_context_of_just_the_question_is_enough():
    pictures = 6 * 19 * 19
    words = 1000
    for context, level in ((1.001, 0), (0.999, 1)):
        profile = read_profile("qwen2.5vl", HERE, context=int((words + pictures + 600) / 0.95 * context))
        assert profile.level(words, 6, 512, 600) == level


def test_the_estimate_says_what_is_known_and_what_a_small_context_costs(tmp_path):
    for address, words in ((HERE, ""), ("http://localhost:11434/v1", "room for 6 of 6 pictures at 384 px only")):
        asking = Asking(
            DryRun(tmp_path), Cache(":memory:"), size=512, model="qwen2.5vl",
            profile=read_profile("qwen2.5vl", address),
        )  # fmt: skip
        estimate = asking.estimate([question("word " * 1200)])
        assert estimate.profile.startswith("taken for Qwen2-VL and Qwen2.5-VL")
        assert words in estimate.profile
        assert ("lvlm.context" in estimate.profile) == bool(words)
        assert estimate.prompt_tokens > 1000
        assert asking.record()["profile"]["model"] == "Qwen2-VL and Qwen2.5-VL"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("models: [", "not YAML"),
        ("models: [{name: x}]", "match"),
        ("models: [{name: x, match: ['*'], tokens: {fixed: 1, patch: 2}}]", "one of fixed, patch and tile"),
        ("servers: {a: {name: x}}", "servers"),
        ("[]", "profiles.yaml"),
        ("models: [{name: x, match: ['*'], colour: red}]", "colour"),
    ],
)
def test_a_table_that_is_malformed_is_refused_with_the_place(tmp_path, text, words):
    file = tmp_path / "profiles.yaml"
    file.write_text(text)
    with pytest.raises(LabelError, match=words):
        read_profile("x", HERE, file)


def test_a_table_of_ones_own_takes_the_place_of_the_built_in_one(tmp_path):
    file = tmp_path / "profiles.yaml"
    file.write_text("models: [{name: Mine, match: ['mine*'], context: 9000, pictures: 2, temperature: false}]")
    profile = read_profile("me/Mine-7B", "http://localhost:11434/v1", file)
    assert (profile.model, profile.server, profile.context) == ("Mine", "", 9000)
    assert (profile.manner.pictures, profile.manner.temperature) == (2, False)
