"""Living people: driver, demonstrator, respondent and reader over a seat. Knows no network."""
