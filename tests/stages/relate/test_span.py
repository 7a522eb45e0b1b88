import numpy as np
import pytest

from cadgraph.stages.relate.span import Span, join_spans


def span(a, b, *points):
    points = np.array(points, np.float64)
    return Span(a, b, (a,), points, float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum()))


@pytest.mark.parametrize(("start", "length"), [(1.0, 2.0), (1.2, 2.2), (0.9, 1.9)])
def test_gaps_count_and_what_lies_in_each_other_counts_once(start, length):
    joined = join_spans(span(0, 1, [0, 0, 0], [1, 0, 0]), span(1, 2, [start, 0, 0], [start + 1.0, 0, 0]))
    assert joined.length == pytest.approx(length)


@pytest.mark.parametrize("noise", [1e-9, -1e-9])
def test_rounding_at_the_end_does_not_turn_a_span_round(noise):
    first = span(0, 1, [0, 0, 0], [1, 0, 0], [1 + noise, 0, 0])
    joined = join_spans(first, span(1, 2, [1.2, 0, 0], [2, 0, 0]))
    assert joined.length == pytest.approx(2.0)
