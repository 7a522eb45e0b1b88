import graphs
from cadlab.reproduce.pie import Slice, distribution, draw_pies


def graph(counts):
    """As many parts as said of each (group, name); of None without label."""
    kinds = [kind for kind, n in counts.items() for _ in range(n)]
    return graphs.graph(graphs.part(i, label=kind and graphs.label(*kind)) for i, kind in enumerate(kinds))


def test_names_are_sectors_by_group_the_commonest_first():
    slices = distribution(graph({("Pipe assembly", "flange"): 2, ("Pipe assembly", "pipe"): 3, ("Tank", "shell"): 1}))
    assert [(one.title, one.count) for one in slices] == [("pipe", 3), ("flange", 2), ("shell", 1)]
    assert len({one.color for one in slices}) == 3


def test_valves_and_gauges_are_one_sector_each():
    counts = {("Valve assembly", "lever"): 2, ("Valve assembly", "valve body"): 3, ("Gauge assembly", "gauge"): 4}
    assert {(one.title, one.count) for one in distribution(graph(counts))} == {
        ("valve assembly", 5),
        ("gauge assembly", 4),
    }


def test_rare_names_go_together_from_the_papers_limit_on():
    # 25 of 2,068 parts are 1.2 %: of 100 parts 2 are enough, 1 is not.
    counts = {("Pipe assembly", "pipe"): 95, ("Pipe assembly", "tee"): 2, ("Tank", "shell"): 1, ("Tank", "saddle"): 1}
    slices = distribution(graph({**counts, ("Pipe assembly", None): 1}))
    assert [(one.title, one.count) for one in slices] == [("pipe", 95), ("tee", 2), ("others", 3)]


def test_parts_without_label_are_a_sector_of_their_own():
    assert distribution(graph({("Tank", "shell"): 1, None: 3}))[-1].title == "unlabelled"
    assert sum(one.count for one in distribution(graph({("Tank", "shell"): 1, None: 3}))) == 4


def test_a_graph_without_parts_has_no_sectors():
    assert distribution(graphs.graph()) == ()
    assert draw_pies([("nothing", ())]).convert("L").getextrema()[1] == 255


def test_sectors_are_drawn_in_their_colours_side_by_side():
    image = draw_pies([("a", [Slice("pipe", 1, "#ff0000")]), ("b", [Slice("tank", 1, "#0000ff")])])
    width, height = image.size
    assert image.getpixel((width // 4, height // 2 + 40)) == (255, 0, 0)
    assert image.getpixel((3 * width // 4, height // 2 + 40)) == (0, 0, 255)


def test_the_drawing_is_the_same_every_time():
    slices = [Slice(f"name {i}", i + 1, "#336699") for i in range(40)]
    assert draw_pies([("many", slices)]).tobytes() == draw_pies([("many", slices)]).tobytes()
