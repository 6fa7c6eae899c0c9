"""Options for colours by an attribute, shared by the commands `map` and `tiles`."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Final

import click

from vexture.base.errors import ParameterError

if TYPE_CHECKING:
    from vexture_geo.maps import Scale

OF_SCALE: Final = ("scale", "palette", "classes", "no_data")
"""Options of colours by an attribute."""


def colour_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options of colours by an attribute, and of the table of attributes, to a command."""
    from vexture_geo.vector.tables import TABLES

    kinds = "quantiles, equal, continuous, categories, or the breaks of classes: 10,20,50."
    listed = (
        click.option("--scale", metavar="KIND", help=f"{kinds}  [default: by the kind of values]"),
        click.option("--classes", metavar="N", type=int, help="Of quantiles and equal.  [default: 5]"),
        click.option(
            "--palette", metavar="NAME", help="Of cmap, such as magma or tab10.  [default: for any colour vision]"
        ),
        click.option("--no-data", metavar="COLOR", help="Of features without a value.  [default: #d9d9d9]"),
        click.option(
            "--table", type=click.Choice(TABLES), default=TABLES[0], show_default=True, help="File of attributes."
        ),
    )
    for option in reversed(listed):
        command = option(command)
    return command


def scale_of(column: str | None, options: Mapping[str, Any]) -> "Scale | None":
    """Make the scale that `colour_options` describe; None without a column."""
    from vexture_geo.maps.colours import Scale

    if column is None:
        return None
    given = {name: options[name] for name in OF_SCALE if options[name] is not None}
    return Scale(column, **{"kind" if name == "scale" else name: value for name, value in given.items()})


def refuse_idle_colours(options: Mapping[str, Any], causes: str = "`color`") -> None:
    """Raise a `ParameterError` for an option of colours by an attribute where there are none."""
    for name in OF_SCALE:
        if options[name] is not None:
            raise ParameterError(f"`{name}` {options[name]} is of colours by an attribute; name its column by {causes}")


def columns_of(text: str | None) -> tuple[str, ...] | None:
    """Split names of columns at commas; None means all."""
    return None if text is None else tuple(part.strip() for part in text.split(","))
