import pytest

import cadplants


def test_old_names_are_the_new_ones_and_warn():
    with pytest.warns(DeprecationWarning, match="STYLES"):
        assert cadplants.HANDS is cadplants.STYLES
    with pytest.raises(AttributeError, match="nothing_such"):
        _ = cadplants.nothing_such
    assert all(getattr(cadplants, name) is not None for name in cadplants.__all__)
