"""The commands `map`, `tiles` and `flood`."""
