"""What a study leaves behind: one schema, its writer, its reader, its codebook."""
