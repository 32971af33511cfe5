"""The report: one self-contained page, its figures, tables and statistics."""

from analysis.report.write import write_report

__all__ = ["write_report"]
