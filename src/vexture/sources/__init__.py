"""Readers: each turns one file format into a `Drawing`; nothing else knows a file format."""
