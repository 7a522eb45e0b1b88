import gc
import weakref
from dataclasses import dataclass

from cadgraph.model.derived import forget, kept_with, once_for_each, store_of


@dataclass(frozen=True, eq=False)
class Value:
    number: int


def test_the_same_objects_give_the_same_result_without_work():
    calls = []

    @kept_with
    def double(value, other):
        calls.append(value.number)
        return [value.number, other]

    one, other, thing = Value(1), Value(2), object()
    assert double(one, thing) is double(one, thing)
    assert double(other, thing) == [2, thing]
    assert double(one, object()) is not double(one, thing)
    assert calls == [1, 2, 1]


def test_stores_of_one_value_are_told_apart_by_name():
    value = Value(1)
    store_of(value, "lines", 3)["a"] = 1
    assert store_of(value, "lines", 3) == {"a": 1}
    assert store_of(value, "lines", 4) == store_of(Value(1), "lines", 3) == {}


def test_what_leads_back_to_the_value_goes_with_it():
    @kept_with
    def of(value):
        return [value]

    value = Value(1)
    seen = weakref.ref(value)
    of(value)
    store_of(value, "others")["itself"] = value
    del value
    gc.collect()
    assert seen() is None


def test_what_is_forgotten_is_worked_out_again():
    asked = []

    @kept_with
    def doubled(value, by):
        asked.append(by)
        return 2 * by

    @kept_with
    def halved(value, by):
        asked.append(-by)
        return by / 2

    value = Value(1)
    doubled(value, 1), halved(value, 1)
    forget(value, doubled)
    forget(value, doubled)
    doubled(value, 1), halved(value, 1)
    assert asked == [1, -1, 1]


def test_the_same_object_is_asked_about_once_and_an_equal_one_again():
    asked = []

    def of(value):
        asked.append(value)
        return [value]

    once = once_for_each(of)
    first, second = [1], [1]
    assert once(first) is once(first) is not once(second)
    assert asked == [[1], [1]]
