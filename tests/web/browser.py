"""Names by which the tests of pages know what the benchmarks use as well."""

from chromium import CHROMIUM, FLAGS, ROOT, WEB, bundle, serve_folder

__all__ = ["CHROMIUM", "FLAGS", "ROOT", "WEB", "bundle", "serve_folder"]
