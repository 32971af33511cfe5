"""Any assistant over courses, limitations, drivers and demonstrators: planned and run."""
