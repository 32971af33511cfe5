"""Power of a protocol's declared analyses, by drawing studies from a pool of people."""
