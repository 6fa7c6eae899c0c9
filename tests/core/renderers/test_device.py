"""The GPU, where there is one, and one line where there is none."""

import os
import subprocess
import sys

import pytest
from hand import FULL, need_gpu, texture_of

from vexture.base.errors import LimitError, ParameterError
from vexture.renderers.device import context
from vexture.thesis.texture import render_thesis_gpu


def test_too_large_a_picture_names_the_limit() -> None:
    need_gpu()
    with context() as gl:
        limit = gl.info["GL_MAX_TEXTURE_SIZE"]
    with pytest.raises((LimitError, ParameterError), match=str(limit)):
        render_thesis_gpu(texture_of([FULL] * 4), (limit + 1, 1))


ONE_LINE = """
import numpy as np
from vexture.thesis.texture import ThesisTexture
from vexture.base.errors import DeviceError
from vexture.conversion.images import coverage
try:
    coverage(ThesisTexture(np.zeros((1, 4, 3), np.uint8), np.zeros((2, 2, 3), np.uint8)), (1, 1), renderer="gpu")
except DeviceError as error:
    print(error)
"""


@pytest.mark.parametrize(
    ("before", "environment", "remedy"),
    [
        ("import sys; sys.modules['moderngl'] = None", {}, "pip install 'vexture[gpu]'"),
        ("", {"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent", "DISPLAY": ""}, "libegl1"),
    ],
)
def test_without_a_gpu_one_line_says_what_to_install(before: str, environment: dict[str, str], remedy: str) -> None:
    need_gpu()
    run = subprocess.run(
        [sys.executable, "-c", before + ONE_LINE],
        env=os.environ | environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert remedy in run.stdout
    assert run.stdout.count("\n") == 1
