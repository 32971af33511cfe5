"""Sections of the reproduction's page."""
