"""The report: one self-contained page with pictures, and ``picture.png`` beside it."""

from cadgraph.draw.report.page import write_report

__all__ = ["write_report"]
