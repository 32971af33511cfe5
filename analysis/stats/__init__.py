"""Tests and estimates: arrays in, one ``TestResult`` out."""
