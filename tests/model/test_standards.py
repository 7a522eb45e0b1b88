from importlib import resources

import pytest

from cadgraph.model.standards import by_size, outer_diameters, read_table

TABLES = sorted(
    path.name.removesuffix(".csv")
    for path in resources.files("cadgraph.model.standards").iterdir()
    if path.name.endswith(".csv")
)


@pytest.mark.parametrize("table", TABLES)
def test_every_row_has_its_source_and_as_many_cells_as_the_head(table):
    for row in read_table(table):
        assert row["source"]
        assert None not in row
        assert None not in row.values()


@pytest.mark.parametrize(("size", "outer"), [(15, 0.0213), (65, 0.0761), (65, 0.073), (90, 0.1016), (1200, 1.219)])
def test_outer_diameters_are_those_of_both_standards(size, outer):
    assert (size, outer) in [(size, round(outer, 6)) for size, outer in outer_diameters()]


def test_each_outer_diameter_belongs_to_one_size():
    outers = [outer for _, outer in outer_diameters()]
    assert len(set(outers)) == len(outers)


def test_lengths_are_by_nominal_size_in_metres():
    assert by_size("face_to_face", "valve", "gate")[50] == 0.178
    assert by_size("fittings", "fitting", "tee")[100] == 0.105


def test_a_table_cant_be_changed_by_who_reads_it():
    with pytest.raises(TypeError):
        read_table("pipes")[0]["dn"] = "7"
