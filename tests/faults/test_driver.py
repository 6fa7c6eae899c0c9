"""A driver that is too old, or has no integer textures: one line, and never a wrong picture."""

import os
import subprocess
import sys

import pytest

from vexture.base.errors import DeviceError
from vexture.renderers.device import context

DRAWING = """
import numpy as np
from vexture.base.errors import DeviceError
from vexture.texture.root import Root
from vexture.texture.texture import Texture
try:
    full = Texture(np.array([[[0, 0, 0, 0xFFFFFFFF]]], np.uint32), (Root("full"),))
    print(full.coverage((1, 1), renderer="gpu"))
except DeviceError as error:
    print(error)
"""


@pytest.mark.parametrize(
    ("override", "value", "said"),
    [
        ("MESA_GL_VERSION_OVERRIDE", "2.1", "no OpenGL 3.3 context without a window"),
        ("MESA_EXTENSION_OVERRIDE", "-GL_EXT_texture_integer", "the OpenGL driver takes no such texture (GL_"),
    ],
)
def test_a_driver_that_cannot_draw_is_one_line(override, value, said):
    try:
        with context() as gl:
            version = gl.info["GL_VERSION"]
    except DeviceError as error:
        pytest.skip(str(error))
    if "Mesa" not in version:
        pytest.skip(f"{version} is not Mesa, which can be told to lack something")
    command = [sys.executable, "-c", DRAWING]
    told = subprocess.run(
        command, env=os.environ | {override: value}, capture_output=True, text=True, check=True
    ).stdout
    assert told.startswith(said)
    assert "or use `renderer` cpu" in told
    assert told.count("\n") == 1
