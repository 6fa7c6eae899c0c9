"""What the tests of fonts share; it puts this folder on the import path, with `made` in it."""

import pytest

from vexture.fonts.face import faces_of
from vexture.fonts.library import default_files


@pytest.fixture(scope="session")
def default_faces():
    """Upright and italic faces of the default font, which is variable."""
    files = default_files()
    if not files:
        pytest.skip("the default font is not installed: pip install 'vexture[text]'")
    return {face.style: face for path in files for face in faces_of(path)}
