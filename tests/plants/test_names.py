import pytest

import cadplants


def test_all_names_are_there_and_no_other():
    with pytest.raises(AttributeError, match="nothing_such"):
        _ = cadplants.nothing_such
    assert all(getattr(cadplants, name) is not None for name in cadplants.__all__)
