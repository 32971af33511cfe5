"""Who takes part: drivers, demonstrators, survey respondents, cohorts. Knows no simulator."""
