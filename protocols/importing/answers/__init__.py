"""Exports of questionnaire services become the answers of a study."""
