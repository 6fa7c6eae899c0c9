"""Waiting for what a page does: for its pictures and its texts, and not for a clock."""

from typing import Any


def drawn(page: Any) -> None:
    """Wait until all that was asked for is on the screen.

    Pages draw in the next animation frame; the one after it begins when that picture is handed over. Transitions of the
    stylesheet are over as well.
    """
    page.evaluate(
        """async () => {
          for (let i = 0; i < 2; i++) await new Promise((next) => requestAnimationFrame(next));
          await Promise.allSettled(document.getAnimations().map(({ finished }) => finished));
        }"""
    )


def quiet(page: Any, frames: int) -> None:
    """Wait until the viewer has drawn nothing for so many animation frames."""
    page.evaluate(
        """async (frames) => {
          let still = 0;
          vexture.viewer.engine.addEventListener('frame', () => { still = 0; });
          while (still++ < frames) await new Promise((next) => requestAnimationFrame(next));
        }""",
        frames,
    )
