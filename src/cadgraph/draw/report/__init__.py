"""The report: one self-contained page with pictures, and ``picture.png`` beside it."""

from cadgraph.draw.report.earlier import marked_as_earlier
from cadgraph.draw.report.page import write_report

__all__ = ["marked_as_earlier", "write_report"]
