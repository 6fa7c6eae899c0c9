"""What every part stands on: errors, notes, limits of time, kernels, and the bits of a texture."""
