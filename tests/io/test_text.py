import xml.etree.ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadgraph._io.text import natural_key, printable, tag_key, xml_text


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
