"""What the viewer lays over the picture, driven as by a person, against the tree as Python reads it."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from overlay_page import Shown, colors, depth_colors, over, ramp

ROUNDING = 2.1  # of 255: the picture below is rounded, and so is what lies over it
OPACITY = {"Cells": 0.6, "Coverage": 0.85, "Depth": 0.75}


def differs(shown: NDArray[np.float64], expected: NDArray[np.float64], where: NDArray[np.bool_]) -> float:
    return float(np.abs(shown - expected).max(axis=-1)[where].max())


VIEWS = [((0.5, 0.5), 1.0), ((0.4999, 0.6251), 120.0), ((0.50001, 0.49999), 10_000.0)]


@pytest.mark.parametrize("name", [pytest.param("duck", marks=pytest.mark.slow), "ocean"])
def test_coverage_and_depth_of_the_cell_at_each_pixel(show: Callable[..., Shown], name: str) -> None:
    shown = show(name)
    for center, zoom in VIEWS:
        shown.look(center, zoom)
        plain, cells = shown.picture(), shown.cells()
        assert cells.inside.any()
        shown.press("Coverage")
        low, high = ramp(shown.page)
        expected = over(plain, low + cells.coverage[..., None] * (high - low), OPACITY["Coverage"])
        assert differs(shown.picture(), expected, cells.clear) <= ROUNDING
        shown.press("Coverage")
        shown.press("Depth")
        expected = over(plain, depth_colors(shown.page)[cells.depth], OPACITY["Depth"])
        picture = shown.picture()
        assert differs(picture, expected, cells.clear) <= ROUNDING
        assert (picture[~cells.inside] == plain[~cells.inside]).all()
        shown.press("Depth")
        assert (shown.picture() == plain).all()


@pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.slow)])
def test_borders_stay_one_pixel_wide_and_contrast_with_the_picture(show: Callable[..., Shown], scheme: str) -> None:
    shown = show("ocean")
    shown.page.emulate_media(color_scheme=scheme)
    for center, zoom in VIEWS:
        shown.look(center, zoom)
        plain, cells = shown.picture(), shown.cells()
        assert cells.border[cells.inside].max() > 0.4
        shown.press("Cells")
        light = plain @ [0.299, 0.587, 0.114]
        line = np.where(light > 127.5, 0.0, 255.0)[..., None]
        expected = over(plain, line, OPACITY["Cells"] * cells.border[..., None])
        clear = cells.inside & (np.abs(light - 127.5) > 1.0)
        assert differs(shown.picture(), expected, clear) <= 4.0
        shown.press("Cells")


def test_the_cut_off_shows_what_quads_store(show: Callable[..., Shown]) -> None:
    shown = show("ocean")
    plain = shown.picture()
    for levels in (5.5, 6.5, 8.0):
        shown.page.get_by_role("slider", name="MIP cut-off").fill(str(levels))
        cells = shown.cells(levels)
        assert cells.is_quad.any()
        low, high = ramp(shown.page)
        expected = np.where(cells.is_quad[..., None], low + cells.coverage[..., None] * (high - low), plain)
        assert differs(shown.picture(), expected, cells.clear) <= ROUNDING


def test_overlays_combine_and_a_link_keeps_them(show: Callable[..., Shown], screenshot: Callable[..., Path]) -> None:
    shown = show("ocean")
    plain, cells = shown.picture(), shown.cells(6.0)
    for name in OPACITY:
        shown.press(name)
        assert shown.page.get_by_role("button", name=name).get_attribute("aria-pressed") == "true"
    slider = shown.page.get_by_role("slider", name="MIP cut-off")
    slider.fill("6")
    stored, coverage = (
        colors(bar.evaluate("bar => getComputedStyle(bar).backgroundImage"))
        for bar in (shown.page.locator(".ramp").nth(1), shown.page.locator(".ramp").nth(0))
    )
    share = cells.coverage[..., None]
    below = np.where(cells.is_quad[..., None], stored[0] + share * (stored[1] - stored[0]), plain)
    tinted = over(below, coverage[0] + share * (coverage[1] - coverage[0]), OPACITY["Coverage"])
    expected = over(np.where(cells.is_quad[..., None], below, tinted), depth_colors(shown.page)[cells.depth], 0.75)
    picture = shown.picture()
    assert differs(picture, expected, cells.clear & (cells.border == 0.0)) <= ROUNDING
    screenshot(shown.page)
    shown.page.wait_for_function("location.hash.endsWith('~7~6~white')")  # all three overlays, and the cut-off
    shown.page.reload()
    shown.page.wait_for_function("window.vexture?.viewer?.ready")
    shown.page.evaluate("vexture.viewer.ready")
    assert (shown.picture() == picture).all()
    assert slider.input_value() == "6"


def test_overlays_tell_of_one_layer(show: Callable[..., Shown]) -> None:
    shown = show("boat")
    plain = shown.picture()
    shown.press("Coverage")
    layers = shown.page.get_by_role("combobox", name="Layer")
    for root, layer in enumerate(shown.texture.roots):
        layers.select_option(layer.name)
        low, high = ramp(shown.page)
        cells = shown.cells(root=root)
        expected = over(plain, low + cells.coverage[..., None] * (high - low), OPACITY["Coverage"])
        assert differs(shown.picture(), expected, cells.clear) <= ROUNDING
    layers.select_option("Under the pointer")
    for u, v, root in ((0.72, 0.72, 1), (0.2, 0.9, 0), (0.4, 0.22, 3), (0.05, 0.1, 2)):
        shown.page.mouse.move(*shown.point(u, v))
        shown.page.get_by_text(f"Shown: {shown.texture.roots[root].name}", exact=True).wait_for()


def test_cells_of_a_map_show_their_mean_colours(show: Callable[..., Shown], screenshot: Callable[..., Path]) -> None:
    shown = show("map")
    plain = shown.picture()
    shown.press("Coverage")
    shown.page.get_by_text("Mean colours of cells, as they are stored").wait_for()
    cells = shown.cells()
    paper = cells.mean[..., 3:] < 1.0  # below a translucent mean is the colour of an empty cell
    expected = over(plain, 255.0 * cells.mean[..., :3], OPACITY["Coverage"])
    sure = cells.clear & ~paper[..., 0]
    assert sure.mean() > 0.3
    assert np.ptp(255.0 * cells.mean[sure][:, :3], axis=0).max() > 100
    screenshot(shown.page)
    assert differs(shown.picture(), expected, sure) <= ROUNDING
    shown.press("Coverage")
    shown.press("Depth")
    depths = over(plain, depth_colors(shown.page)[cells.depth], OPACITY["Depth"])
    assert differs(shown.picture(), depths, cells.clear) <= ROUNDING


def test_off_the_flat_view_overlays_say_why_they_are_not_there(show: Callable[..., Shown]) -> None:
    shown = show("duck")
    shown.page.get_by_role("combobox", name="Surface").select_option("Plane")
    shown.page.get_by_text("Cells and what is in them are shown in the flat view.").wait_for()
    for name in OPACITY:
        assert shown.page.get_by_role("button", name=name, exact=True).is_disabled()
    shown.page.get_by_role("combobox", name="Surface").select_option("Flat")
    assert shown.page.get_by_role("button", name="Cells", exact=True).is_enabled()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "scheme"), [("duck", "light"), ("ocean", "dark"), ("font", "light"), ("boat", "light"), ("boat", "dark")]
)
def test_pictures_for_people(
    show: Callable[..., Shown], screenshot: Callable[..., Path], name: str, scheme: str
) -> None:
    shown = show(name)
    shown.page.emulate_media(color_scheme=scheme)
    shown.press("Cells")
    plain = shown.picture()
    screenshot(shown.page, "cells")
    for label in ("Coverage", "Depth"):
        shown.press(label)
        assert (shown.picture() != plain).any()
        screenshot(shown.page, label.lower())
        shown.press(label)
