"""The sections of the report: results in, one ``Section`` out, one file each."""
