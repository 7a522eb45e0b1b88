import xml.etree.ElementTree as ElementTree

from cadgraph.draw.report.chart import Bar, draw_bars

BARS = [
    Bar("Pipe assembly", "#8a45e6", (("pipe", 30), ("elbow", 10), ("tee", 1))),
    Bar("<b>odd</b> & 'quoted'", "#1f86f0", (("<script>", 3),)),
    Bar("unlabelled", "#d3d8de", (("no label", 6),), hatched=True),
]


def drawn(bars):
    return ElementTree.fromstring(str(draw_bars(bars)))


def test_drawing_is_well_formed_whatever_the_names():
    assert drawn(BARS).tag == "svg"
    assert "<script>" not in draw_bars(BARS)


def test_widths_follow_the_counts():
    widths = {group.find("title").text: float(group.find("rect").get("width")) for group in drawn(BARS).iter("g")}
    assert abs((widths["pipe: 30"] + 1) / (widths["elbow: 10"] + 1) - 3) < 0.01


def test_counts_and_shares_are_written():
    texts = ["".join(text.itertext()) for text in drawn(BARS).iter("text")]
    assert any(text.startswith("41 82.0 %") for text in texts)


def test_names_that_do_not_fit_stand_beside_the_bar():
    bars = [Bar("a", "#000000", (("pipe", 100),)), Bar("b", "#000000", (("elbow", 1), ("tee", 1)))]
    texts = ["".join(text.itertext()) for text in drawn(bars).iter("text")]
    assert any("elbow, tee" in text for text in texts)


def test_nothing_to_draw():
    assert draw_bars([]) == ""
    assert draw_bars([Bar("empty", "#000000", ())]) == ""
