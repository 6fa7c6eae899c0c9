"""What is seen on the page of a flood: its views, its water, and where places are in the picture."""

import base64

import flood_page
import numpy as np
from numpy.typing import NDArray
from playwright.sync_api import Page

SMALL = (480, 320)
WIDE = (740, 500)
"""On which the panel is open."""
DEEP = (0.5, 0.3)
"""A place in the unit square that is always under water."""

PATIENCE = 60_000
"""Milliseconds: the first picture waits for a software renderer's compiler."""


def view(page: Page, preset: str) -> None:
    """Look from a preset at once."""
    page.evaluate("(preset) => vexture.flood.view(preset, { fly: false })", preset)


def flat(page: Page) -> NDArray[np.uint8]:
    """Picture of the flat water, 0 where the ground is, 255 where the water is."""
    size = page.evaluate("""() => {
        vexture.flood.flat(true);
        const gl = vexture.flood.stage.renderer.getContext();
        window.flatPixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
        vexture.flood.render();
        gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, flatPixels);
        return [gl.drawingBufferHeight, gl.drawingBufferWidth];
    }""")
    pixels = page.evaluate("btoa(Array.from(flatPixels, (byte) => String.fromCharCode(byte)).join(''))")
    return np.frombuffer(base64.b64decode(pixels), np.uint8).reshape(*size, 4)[::-1]


def on_screen(page: Page, u: float, v: float) -> tuple[float, float]:
    """Pixel at which a place of the water is seen."""
    u0, v0, u1, v1 = flood_page.FRAME.box
    width, depth = 100.0, 75.0
    x, z = ((u - u0) / (u1 - u0) - 0.5) * width, (0.5 - (v - v0) / (v1 - v0)) * depth
    seen = page.evaluate(
        """([x, z]) => {
            const { camera, stage } = vexture.flood;
            camera.updateMatrixWorld();
            const at = camera.position.clone().set(x, 0, z).project(camera);
            if (Math.abs(at.z) > 1) return [-1, -1]; // behind the camera
            return [(at.x + 1) / 2 * stage.size.width, (1 - at.y) / 2 * stage.size.height];
        }""",
        [x, z],
    )
    return seen[0], seen[1]
