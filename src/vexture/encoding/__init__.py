"""Encodings: each turns a `CellTree` into textures and back."""
