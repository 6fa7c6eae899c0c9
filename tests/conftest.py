"""Shared by all tests; its presence puts this folder on the import path, so that `strategies` can be imported."""
