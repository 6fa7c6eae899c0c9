"""What arguments of several commands may be."""

from typing import Any

import click

__all__ = ["Tolerance"]


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
