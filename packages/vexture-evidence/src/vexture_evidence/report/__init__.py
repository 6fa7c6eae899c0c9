"""The evidence as one page: every table and figure of the thesis, measured again."""
