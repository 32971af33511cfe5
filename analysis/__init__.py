"""From a study directory to tables, tests, figures and a report. Knows no simulator."""
