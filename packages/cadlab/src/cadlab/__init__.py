"""The workshop of cadgraph: evaluation, the paper's experiments, training and benchmarks; users need none of it."""

__version__ = "0.1.0"
