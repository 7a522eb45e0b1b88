import pytest

from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.price import read_price, text_tokens


@pytest.mark.parametrize(
    ("width", "height", "detail", "tokens"),
    [
        (512, 512, "high", 255),
        (512, 512, "low", 85),
        (513, 512, "high", 425),
        (1024, 1024, "high", 765),
        (2048, 4096, "high", 1105),
    ],
)
def test_pictures_cost_what_the_provider_says(width, height, detail, tokens):
    assert read_price("gpt-4o").image_tokens(width, height, detail) == tokens


def test_the_longest_key_counts():
    assert read_price("gpt-4o-mini-2024-07-18").input == pytest.approx(0.15)
    assert read_price("gpt-4o-2024-08-06").input == pytest.approx(2.5)
    assert read_price("gpt-4.1-mini").image_tokens(512, 512, "high") == pytest.approx(1.62 * 256)


def test_a_batch_costs_half():
    price = read_price("gpt-4o")
    assert price.cost(1e6, 0) == pytest.approx(2.5)
    assert price.cost(1e6, 1e6, batch=True) == pytest.approx(6.25)


def test_unknown_models_have_no_price_but_ones_own_server_bills_nothing():
    assert read_price("llava") is None
    assert read_price("llava", local=True).cost(1e9, 1e9) == 0


def test_a_table_of_ones_own(tmp_path):
    path = tmp_path / "prices.yaml"
    path.write_text("llava: {input: 1, output: 2, image: {fixed: 10}}\n")
    assert read_price("llava-13b", path).cost(1e6, 1e6) == pytest.approx(3)
    assert read_price("gpt-4o", path) is None


@pytest.mark.parametrize(
    "content", ["[1]", "llava: 3", "llava: {input: -1, output: 1}", "llava: {cheap: yes}", ": :\n  - ["]
)
def test_a_table_that_is_none_is_refused(tmp_path, content):
    path = tmp_path / "prices.yaml"
    path.write_text(content)
    with pytest.raises(LabelError, match=r"prices\.yaml"):
        read_price("llava", path)
    with pytest.raises(LabelError, match="no such file"):
        read_price("llava", tmp_path / "none.yaml")


def test_tokens_grow_with_the_text():
    short, long = text_tokens("a flange"), text_tokens("a flange " * 100)
    assert 0 < short < long
    assert text_tokens("x" * 700) >= 100
