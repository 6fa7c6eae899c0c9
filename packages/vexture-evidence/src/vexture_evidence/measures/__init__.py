"""Measures of rendering methods: errors against the truth, times and bytes; and the methods that are compared."""
