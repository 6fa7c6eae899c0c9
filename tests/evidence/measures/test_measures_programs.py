"""Texts of the shaders that are compared, and lists of texels in the rows of a texture."""

import numpy as np
import pytest

from vexture_evidence.measures.programs import VERSION, fetch_source, fragment, packed_source, rows_of


@pytest.mark.parametrize(("count", "rows"), [(1, 1), (8, 1), (9, 2), (16, 2), (17, 3)])
def test_a_list_is_in_rows_and_the_rest_of_the_last_is_empty(count, rows):
    values = np.arange(1, 2 * count + 1, dtype=np.uint32).reshape(count, 2)
    found = rows_of(values, 8)
    assert found.shape == (rows, 8, 2)
    assert found.dtype == np.uint32
    np.testing.assert_array_equal(found.reshape(-1, 2)[:count], values)
    assert not found.reshape(-1, 2)[count:].any()


def test_a_shader_has_its_call_in_the_common_main():
    text = fragment("uniform float half;\n", "half * uv.x")
    assert text.startswith(f"#version {VERSION}\nuniform float half;\n")
    assert text.count("coverage_of_pixel = half * uv.x;") == 1
    assert "texture(image, uv).x" in fetch_source()


def test_only_the_flat_shader_takes_what_all_pixels_have_in_common():
    flat, of_any = packed_source(is_flat=True), packed_source()
    assert "uniform vec2 extent;" in flat
    assert "uniform vec2 extent;" not in of_any
    assert "= vextureFlatCoverage(root, base, uv, VextureFlat(extent, inverse_area, finest));" in flat
    assert "= vextureCoverage(root, base, uv, dx, dy);" in of_any
