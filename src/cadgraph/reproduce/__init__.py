"""The paper's experiments, run again on generated plants, with the paper's figures beside ours."""

from cadgraph.reproduce.experiment import LABELINGS, Labeling
from cadgraph.reproduce.reproduction import reproduce

__all__ = ["LABELINGS", "Labeling", "reproduce"]
