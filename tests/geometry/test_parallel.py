import threading

import pytest

from cadgraph.geometry.kernels.parallel import in_turn


@pytest.mark.parametrize("workers", [None, 1, 2, 5])
@pytest.mark.parametrize("n", [0, 1, 7])
def test_what_threads_work_out_comes_in_order(n, workers):
    assert list(in_turn(lambda number: number * number, n, workers)) == [number * number for number in range(n)]


def test_as_many_are_worked_out_at_a_time_as_there_are_threads():
    both = threading.Barrier(2)

    def act(number):
        both.wait(timeout=60)
        return number

    assert list(in_turn(act, 4, 2)) == [0, 1, 2, 3]


def test_error_of_one_is_raised_in_its_turn():
    def act(number):
        if number == 2:
            raise KeyError(number)
        return number

    found = in_turn(act, 4, 2)
    assert [next(found), next(found)] == [0, 1]
    with pytest.raises(KeyError, match="2"):
        next(found)


def test_fewer_than_one_thread_is_refused():
    with pytest.raises(ValueError, match="workers is 0; give at least 1"):
        list(in_turn(lambda number: number, 3, 0))
