import xml.etree.ElementTree as ET

from hypothesis import given
from hypothesis import strategies as st

from cadgraph.draw.svg import Svg, element, joined, number


def test_an_element_has_its_attributes_in_order_and_numbers_to_a_hundredth():
    drawn = element("rect", class_="a", x=1.0, y=-0.001, stroke_width=2.345, fill=None)
    assert drawn == '<rect class="a" x="1" y="0" stroke-width="2.35"/>'


def test_texts_are_escaped_and_svg_is_not():
    inner = element("title", "a < b & c")
    assert element("g", inner, '"x"') == "<g><title>a &lt; b &amp; c</title>&quot;x&quot;</g>"
    assert inner + "<b>" == "<title>a &lt; b &amp; c</title>&lt;b&gt;"
    assert isinstance(inner + inner, Svg)


def test_pieces_follow_each_other():
    assert joined([Svg("<a/>"), "<"]) == "<a/>&lt;"
    assert joined([]) == ""


def test_a_template_that_escapes_takes_svg_as_it_is():
    import jinja2

    template = jinja2.Environment(autoescape=True).from_string("{{ drawn }}")
    assert template.render(drawn=element("g", "<")) == "<g>&lt;</g>"


@given(st.text(st.characters()), st.text(st.characters()))
def test_any_text_makes_a_well_formed_document(text, value):
    ET.fromstring(element("text", text, title=value))


@given(st.floats(-1e6, 1e6))
def test_numbers_are_plain_and_near(value):
    assert abs(float(number(value)) - value) <= 0.0051
    assert "e" not in number(value)
    assert number(value) != "-0"
