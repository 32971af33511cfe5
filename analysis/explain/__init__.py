"""What a learnt policy says about helping: what it depends on, leans on, and is unsure of."""
