"""What the shader of layers reads of each layer: its quad, its paint and its box."""

import numpy as np

from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture_evidence.measures.colour_fetches import SheetStack, layer_boxes
from vexture_evidence.measures.colour_programs import ONE, layers_image, map_source


def box(low, high, paint):
    contours = Drawing.polygon([(low, 0.25), (high, 0.25), (high, 1.0), (low, 1.0)]).paths[0].contours
    return Path(contours, paint=paint)


def test_rows_have_the_colours_and_boxes_of_the_layers():
    drawing = Drawing((box(0.0, 0.5, Paint((1.0, 0.0, 0.2))), box(0.125, 1.0, Paint((0.0, 1.0, 0.4), 0.6))))
    made = run(drawing, Parameters("paint"))
    rows = layers_image(SheetStack(made.texture, layer_boxes(made.drawing.layers())))
    assert rows.shape == (2, 2, 4)
    assert rows[:, 0, 0].tolist() == [root.quad for root in made.texture.roots]
    assert not rows[:, 0, 3].any()  # none of them is a map
    channels = np.stack([rows[:, 0, 1] & 0xFFFF, rows[:, 0, 1] >> 16, rows[:, 0, 2] & 0xFFFF, rows[:, 0, 2] >> 16], 1)
    wanted = [(1.0, 0.0, 0.2, 1.0), (0.0, 1.0, 0.4, 0.6)]
    np.testing.assert_allclose(channels / 65535.0, wanted, atol=1e-5)
    low, high = rows[:, 1, :2] / ONE, rows[:, 1, 2:] / ONE
    assert (low <= [(0.0, 0.25), (0.125, 0.25)]).all()
    assert (high >= [(0.5, 1.0), (1.0, 1.0)]).all()
    np.testing.assert_allclose(high - low, [(0.5, 0.75), (0.875, 0.75)], atol=0.05)


def test_variants_of_the_shader_differ_by_their_definitions_alone():
    texts = {flags: map_source(is_flat=flags[0], gradients=flags[1]) for flags in ((0, 0), (1, 0), (0, 1))}
    assert "#define VEXTURE_FLAT 1\n" in texts[1, 0]
    assert "#define VEXTURE_GRADIENTS 1\n" in texts[0, 1]
    for text in texts.values():
        assert text.startswith("#version 330\n")
        assert "CALL" not in text
    alike = [text.replace("FLAT 1\n", "FLAT 0\n").replace("GRADIENTS 1\n", "GRADIENTS 0\n") for text in texts.values()]
    assert alike == alike[:1] * 3
