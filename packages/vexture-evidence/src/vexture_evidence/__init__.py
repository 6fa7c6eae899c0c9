"""The evidence for vexture: measures, rivals, figures and the report."""
