"""A drawing's picture shows it, its cells and its texels; a texture's shows it, in notebooks too."""

import base64
import io

import numpy as np
import pytest
from fitting import assert_legible
from PIL import Image

import vexture
from vexture.base.errors import ParameterError
from vexture.drawing.drawing import Drawing, FillRule
from vexture.renderers.exact import render_exact
from vexture.texture.texture import Texture
from vexture_evidence.figures.overview import overview, picture_error, summary
from vexture_evidence.measures.leaves import leaves
from vexture_evidence.measures.shape import example, file_bytes

STAR = [(0.5 + 0.4 * np.sin(0.8 * np.pi * k), 0.5 + 0.4 * np.cos(0.8 * np.pi * k)) for k in range(5)]
DRAWINGS = {
    "empty": Drawing(()),
    "full": Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]),
    "star": Drawing.polygon(STAR, fill_rule=FillRule.EVENODD),
    "low": Drawing.polygon([(0, 0), (1, 0), (1, 0.05), (0, 0.07)]),
}
WAYS = {"sampled": {"encoding": "thesis", "strategy": "sampled"}, "direct": {"encoding": "thesis"}, "packed": {}}


@pytest.mark.slow
@pytest.mark.parametrize("name", DRAWINGS)
def test_overview_of_any_drawing_is_legible(name):
    drawing = DRAWINGS[name]
    made = {way: vexture.convert(drawing, **given) for way, given in WAYS.items()}
    figure = overview(drawing, made)
    assert_legible(figure)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert titles[:4] == [
        f"drawing: {drawing.segments} segments",
        *(f"{way}: {len(leaves(texture).x)} cells" for way, texture in made.items()),
    ]
    for title, texture in zip(titles[5:], made.values(), strict=True):
        assert title.startswith(f"{file_bytes(texture):,} bytes, error ")


def test_overview_shows_the_drawing_and_what_the_last_texture_draws():
    drawing = DRAWINGS["star"]
    figure = overview(drawing, {"packed": vexture.convert(drawing)}, size=64)
    truth = render_exact(drawing, (64, 64))
    assert np.array_equal(figure.axes[0].images[0].get_array(), truth)
    picture = next(axes for axes in figure.axes if axes.get_title(loc="left") == "picture from packed")
    np.testing.assert_allclose(picture.images[0].get_array(), truth, atol=1e-3)


def test_error_is_that_of_the_texture():
    low, star = DRAWINGS["low"], DRAWINGS["star"]
    assert picture_error(star, vexture.convert(star), 64)[1] < 0.1
    assert picture_error(star, vexture.convert(low), 64)[1] > 100


@pytest.mark.parametrize(("plot", "given"), [(Texture.plot, {}), (summary, {}), (summary, {"encoding": "thesis"})])
@pytest.mark.parametrize("name", DRAWINGS)
def test_plot_shows_cells_coverage_and_picture(name, plot, given):
    figure = plot(vexture.convert(DRAWINGS[name], **given))
    assert [axes.get_title(loc="left") for axes in figure.axes[:3]] == ["cells", "coverage", "picture"]
    assert_legible(figure)
    np.testing.assert_allclose(figure.axes[2].images[0].get_array(), render_exact(DRAWINGS[name], (256, 256)), atol=0.2)


def test_plot_shows_the_shape_that_is_asked_for():
    both = vexture.atlas([example("duck"), example("holes")])
    holes = summary(vexture.convert(example("holes"))).axes[2]
    for plot in (Texture.plot, summary):
        named = plot(both, root="holes").axes[2]
        assert named.get_title(loc="left") == "picture of holes"
        assert np.array_equal(named.images[0].get_array(), holes.images[0].get_array())
        assert not np.array_equal(named.images[0].get_array(), plot(both, root="duck").axes[2].images[0].get_array())
        with pytest.raises(ParameterError, match=r"choose one by `root`"):
            plot(both)


@pytest.mark.slow
def test_plot_shows_itself_in_a_notebook():
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    lines = f"import vexture\ntexture = vexture.convert({str(example('duck'))!r})\ntexture.plot()"
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(lines)])
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    (output,) = (each for each in notebook.cells[0].outputs if each.output_type == "execute_result")
    image = Image.open(io.BytesIO(base64.b64decode(output.data["image/png"])))
    assert image.width > 2 * image.height
    assert len(image.convert("RGB").getcolors(1 << 20)) > 50
