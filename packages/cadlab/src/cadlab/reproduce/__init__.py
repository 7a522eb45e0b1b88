"""The paper's experiments, run again on generated plants, with the paper's figures beside ours."""

from cadlab.reproduce.experiment import LABELINGS, Labeling
from cadlab.reproduce.reproduction import reproduce

__all__ = ["LABELINGS", "Labeling", "reproduce"]
