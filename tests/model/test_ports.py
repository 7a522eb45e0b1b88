import pytest

from cadgraph.model.ports import has_more_ways, least_ports, port_word


@pytest.mark.parametrize(
    ("unit_type", "kind", "count"),
    [
        ("valve", None, 2),
        ("valve", "check valve", 2),
        ("valve", "three-way ball valve", 3),
        ("valve", "3 way plug valve", 3),
        ("valve", "relief valve", 1),
        ("valve", "Safety Valve", 1),
        ("pump", "centrifugal pump", 2),
        ("gauge", "pressure gauge", 1),
        ("gauge", "flow meter", 2),
        ("tank", "horizontal tank", 1),
        ("equipment", None, 1),
        ("equipment", "heat exchanger", 2),
        ("rotor", None, 1),
    ],
)
def test_the_fewest_lines_of_a_kind(unit_type, kind, count):
    assert least_ports(unit_type, kind) == count


def test_pumps_tanks_and_equipment_have_nozzles():
    assert [port_word(name) for name in ("pump", "tank", "equipment", "valve", "gauge")] == [
        "nozzle", "nozzle", "nozzle", "port", "port",
    ]  # fmt: skip


@pytest.mark.parametrize(
    "kind",
    [
        "3-way ball valve",
        "three way plug valve",
        "Four-way cock",
        "multi-port ball valve",
        "multiport valve",
        "6 port valve",
        "diverter valve",
        "L-port ball valve",
        "T port ball valve",
        "change-over valve",
        "selector valve",
    ],
)
def test_a_valve_of_more_than_two_ways_is_known_by_its_kind(kind):
    assert has_more_ways(kind)


@pytest.mark.parametrize(
    "kind", ["ball valve", "two-way ball valve", "2-way valve", "full-port ball valve", "outlet port valve"]
)
def test_a_valve_of_two_ways_is_none_of_more(kind):
    assert not has_more_ways(kind)
