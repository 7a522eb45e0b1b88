import pytest

from cadgraph.model.ports import least_ports, port_word


@pytest.mark.parametrize(
    ("unit_type", "kind", "count"),
    [
        ("valve", None, 2),
        ("valve", "check valve", 2),
        ("valve", "three-way ball valve", 3),
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
