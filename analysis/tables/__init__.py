"""The report's tables: the study's frames in, one data frame out, one file each."""
