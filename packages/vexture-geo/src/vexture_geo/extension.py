"""Functions that vexture calls through the entry point `vexture.readers`: see `vexture.conversion.extensions`."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from vexture.base.content import FileKind, read_bytes, start_of
from vexture.base.errors import ParameterError

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing

Source: TypeAlias = str | os.PathLike[str] | bytes


def unpack(source: Source, file_name: str) -> Source:
    """Return the source, or the content of a zip; refuse formats of flood models that are not supported."""
    from vexture_geo.base.foreign import refuse_foreign
    from vexture_geo.vector.archives import unzip

    held = unzip(source)
    refuse_foreign(start_of(held), file_name)
    return held


def pack(path: Path) -> bytes | None:
    """Pack the files of a shapefile or FileGDB into one zip; return None for anything else."""
    from vexture_geo.vector.archives import pack_parts

    return pack_parts(path)


def read_drawing(
    kind: FileKind, source: Source, file_name: str, name: str, *, names: str | None, snap: float | None
) -> "Drawing":
    """Read the areas of a file, at the first of its times."""
    if kind is FileKind.GEOJSON:
        from vexture_geo.vector.geojson import geojson_drawing

        return geojson_drawing(read_bytes(source), name, names=names, snap=snap)
    from vexture_geo.readers import read_first_step

    return read_first_step(source, file_name, snap)


def describe_tiles(path: Path) -> tuple[dict[str, Any], list[str]] | None:
    """Describe a pyramid of tiles, as JSON and in lines; return None for anything else."""
    from vexture_geo.tiles.describe import facts_of, is_pyramid, lines_of

    if not is_pyramid(path):
        return None
    facts = facts_of(path)
    return facts, [*lines_of(facts)]


def flood_widget(source: Any, options: dict[str, Any]) -> Any:
    """Make the widget of a flood from its page, an extent or a dataset; return None for anything else.

    `options` are those of the page; a page that exists already takes only its height.
    """
    from vexture_geo.base.datasets import is_dataset
    from vexture_geo.base.extent import Extent
    from vexture_geo.flood.page import FloodPage, flood_page

    if isinstance(source, Extent) or is_dataset(source):
        source, options = flood_page(source, **options), {}
    elif not isinstance(source, FloodPage):
        return None
    for option, value in options.items():
        if option != "height":
            raise ParameterError(f"`{option}` is {value!r}, but {source.title} is converted already; leave it out")
    from vexture_geo.flood.widget import FloodWidget

    return FloodWidget(source, **options)
