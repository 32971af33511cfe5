"""What a study records: one schema, its writer, its reader, its codebook."""
