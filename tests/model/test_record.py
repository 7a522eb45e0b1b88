import pytest
from pydantic import ValidationError

from cadgraph.model.labels import Guess
from cadgraph.model.record import Record


class Small(Record):
    name: str
    size: float = 1.0


def test_records_keep_what_they_do_not_know_each_for_itself():
    first, second = Small(name="a", colour="red"), Small(name="b")
    assert first.model_extra == {"colour": "red"}
    assert second.model_extra == {}
    assert first.model_dump() == {"name": "a", "size": 1.0, "colour": "red"}


def test_a_copy_has_what_was_put_in_and_leaves_the_others_as_they_are():
    first, second = Small(name="a"), Small(name="b")
    copied = first.model_copy(update={"size": 2.0, "weight": 3.0})
    assert copied.model_dump() == {"name": "a", "size": 2.0, "weight": 3.0}
    assert first.model_extra == second.model_extra == {}
    assert first == Small(name="a", size=1.0)


def test_records_stay_frozen_and_can_be_keys():
    one = Guess("Pump", "pump", 0.5)
    assert {one: 1}[Guess("Pump", "pump", 0.5)] == 1
    with pytest.raises(ValidationError):
        one.group = "Tank"


def test_records_from_json_share_what_none_of_them_says():
    first, second = (Small.model_validate_json('{"name": "a"}') for _ in range(2))
    # A set and a table for each would take more memory than the values.
    assert first.__pydantic_fields_set__ is second.__pydantic_fields_set__
    assert first.__pydantic_extra__ is second.__pydantic_extra__
