"""Foundation of all folders: errors, notes, time limits, kernels, and the bit layout of a texture."""
