"""The base of every part: errors, notes, time limits, kernels, and the bits of a texture."""
