import pytest

from cadgraph.model.parts import Link, Network, Opening, Place, UnitParts
from cadgraph.stages.relate.stub import drop_stubs

AT = ((0.0, 0.0, 0.0),)
LONG = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))


def unit(tag, n_openings):
    return UnitParts("valve", tag, (0,), openings=tuple(Opening((float(k), 0.0, 0.0)) for k in range(n_openings)))


def open_end():
    return Place("open", (0.0, 0.0, 0.0), ())


def test_a_stub_goes_with_its_end_and_its_opening():
    stub, pipe = Link(0, 1, (), AT, 0.0, source_port=0), Link(0, 2, (5,), LONG, 1.0, source_port=1)
    network = Network((unit("V-001", 2),), (open_end(), open_end()), (stub, pipe), ((0, 1, 2),))
    found = drop_stubs(network)
    assert found.links == (Link(0, 1, (5,), LONG, 1.0, source_port=0),)
    assert [opening.point[0] for opening in found.units[0].openings] == [1.0]
    assert found.places == (open_end(),)
    assert found.systems == ((0, 1),)


def test_a_unit_that_had_nothing_but_a_stub_is_in_no_system_any_more():
    network = Network((unit("V-001", 1),), (open_end(),), (Link(0, 1, (), AT, 0.0, source_port=0),), ((0, 1),))
    found = drop_stubs(network)
    assert (found.links, found.places, found.systems, found.units[0].openings) == ((), (), (), ())


@pytest.mark.parametrize(
    "link",
    [
        Link(0, 1, (7,), AT, 0.0, source_port=0),  # over a part
        Link(0, 1, (), LONG, 2e-6, source_port=0),  # with a length
    ],
)
def test_an_end_over_a_part_or_with_a_length_stays(link):
    network = Network((unit("V-001", 1),), (open_end(),), (link,), ((0, 1),))
    assert drop_stubs(network) is network


def test_units_flange_to_flange_stay_connected_over_no_length():
    link = Link(0, 1, (), AT, 0.0, source_port=0, target_port=0)
    network = Network((unit("V-001", 1), unit("V-002", 1)), (), (link,), ((0, 1),))
    assert drop_stubs(network) is network


def test_a_junction_right_at_a_unit_stays():
    links = (
        Link(0, 1, (), AT, 0.0, source_port=0),
        *(Link(1, end, (end,), LONG, 1.0) for end in (2, 3)),
    )
    places = (Place("junction", (0.0, 0.0, 0.0), ()), open_end(), open_end())
    network = Network((unit("V-001", 1),), places, links, ((0, 1, 2, 3),))
    assert drop_stubs(network) is network


def test_an_opening_that_another_link_uses_stays():
    links = (Link(0, 1, (), AT, 0.0, source_port=0), Link(0, 2, (5,), LONG, 1.0, source_port=0))
    network = Network((unit("V-001", 1),), (open_end(), open_end()), links, ((0, 1, 2),))
    assert len(drop_stubs(network).units[0].openings) == 1


def test_an_opening_without_any_link_stays():
    network = Network((unit("V-001", 2),), (open_end(),), (Link(0, 1, (), AT, 0.0, source_port=0),), ((0, 1),))
    assert [opening.point[0] for opening in drop_stubs(network).units[0].openings] == [1.0]
