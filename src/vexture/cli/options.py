"""Types of options, and options that several commands have."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import click

from vexture.settings import Settings

__all__ = ["Tolerance", "conversion_options", "viewer_settings"]


class Tolerance(click.ParamType[Any]):
    """A number, or auto."""

    name = "T"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the number, or the word."""
        if value == "auto" or isinstance(value, float):
            return value
        try:
            return float(value)
        except ValueError:
            self.fail(f"{value!r} is neither a number nor auto", param, ctx)


def conversion_options(command: Callable[..., None]) -> Callable[..., None]:
    """Options of how the viewer converts."""
    for option in (
        click.option("--select", metavar="SELECTOR", help="Show only the elements that a CSS selector matches."),
        click.option("--precision", metavar="P", type=float, help="Largest shift by rounding.  [default: 1e-7]"),
        click.option(
            "--tolerance",
            type=Tolerance(),
            default="auto",
            show_default=True,
            help="Largest distance from the drawing's outline, in drawing sizes; auto is 0.",
        ),
    ):
        command = option(command)
    return command


def viewer_settings(tolerance: Any, precision: float | None, select: str | None) -> Settings:
    """Settings of the viewer, but for what the options say."""
    from vexture.live.documents import VIEWER_SETTINGS

    most = VIEWER_SETTINGS.precision if precision is None else precision
    return replace(VIEWER_SETTINGS, tolerance=tolerance, precision=most, select=select)
