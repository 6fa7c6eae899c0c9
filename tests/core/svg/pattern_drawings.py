"""Drawings with patterns, and how two of them differ."""

import warnings

import numpy as np

import vexture
from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact_colours

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'

PATTERN = '<pattern id="p" patternUnits="userSpaceOnUse" {}>{}</pattern>'

DOT = '<circle cx="5" cy="5" r="3" fill="red"/>'

RECT, DISC = '<rect id="a" width="100" height="100" {}/>', '<circle id="a" cx="50" cy="50" r="50" {}/>'

FILLED = 'fill="url(#p)"'


def drawing_of(body: str, head: str = HEAD) -> Drawing:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return vexture.read(f"{head}{body}</svg>".encode())


def dots(attributes: str, fill: str = FILLED) -> str:
    return PATTERN.format(attributes, DOT) + RECT.format(fill)


SIZE = 'width="10" height="10"'


def gap(body: str, plain: str) -> float:
    ours, theirs = (render_exact_colours(drawing_of(text), (160, 160)) for text in (body, plain))
    return float(np.abs(ours - theirs).max())
