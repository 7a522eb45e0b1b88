import xml.etree.ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadgraph._io.text import natural_key, natural_order, printable, shortened, tag_key, xml_text


def test_numbers_sort_by_value_and_paths_before_those_below_them():
    paths = ["/a/pipe_10", "/a/pipe_2", "/a b", "/a", "/a/pipe_2/x", "/B"]
    assert sorted(paths, key=natural_key) == ["/B", "/a", "/a/pipe_2", "/a/pipe_2/x", "/a/pipe_10", "/a b"]


def test_tags_sort_without_regard_to_capitals():
    assert sorted(["V-10", "junction-1", "v-9", "G-1"], key=tag_key) == ["G-1", "junction-1", "v-9", "V-10"]


@given(st.text(), st.text())
def test_any_two_texts_can_be_sorted_and_different_ones_differ(a, b):
    assert (natural_key(a) == natural_key(b)) == (a == b)
    assert natural_key(a) < natural_key(b) or natural_key(b) <= natural_key(a)


@pytest.mark.parametrize(("text", "shown"), [("a\x1b[31mb", "a?[31mb"), ("é ∅", "é ∅"), ("a\nb\ud800", "a?b?")])
def test_what_cant_be_printed_is_replaced(text, shown):
    assert printable(text, "?") == shown


@given(st.text(st.characters()))
def test_xml_text_can_stand_in_a_document(text):
    ET.fromstring(ET.tostring(ET.Element("a", value=xml_text(text))))
    assert xml_text(xml_text(text)) == xml_text(text)


@given(st.lists(st.text(st.sampled_from("ab/019_ \x00\x01\x02é"), max_size=8)))
def test_the_fast_order_is_that_of_the_key(texts):
    assert natural_order(texts) == sorted(range(len(texts)), key=lambda i: natural_key(texts[i]))


@given(st.lists(st.text(st.sampled_from("ab/0123_"), max_size=12)))
def test_the_fast_order_is_that_of_the_key_for_plain_texts(texts):
    assert natural_order(texts) == sorted(range(len(texts)), key=lambda i: natural_key(texts[i]))


@given(st.text(max_size=12), st.integers(1, 12))
def test_what_is_cut_is_as_long_as_it_may_be_and_says_so(text, most):
    cut = shortened(text, most)
    assert len(cut) <= most
    assert cut == text if len(text) <= most else cut.endswith("…") and text.startswith(cut[:-1])
