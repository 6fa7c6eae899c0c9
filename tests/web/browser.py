"""Names by which the tests of pages know what the benchmarks use as well."""
