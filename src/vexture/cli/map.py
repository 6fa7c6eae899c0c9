"""The command `map`."""

from pathlib import Path
from typing import Any

import click

from vexture.cli.messages import one_line, say
from vexture.cli.options import PATH, Colour, strict_option, tolerance_option
from vexture.errors import ParameterError, SourceError, counted
from vexture.layout import PACKED_SUFFIX

__all__ = ["map"]

TABLES = (".parquet", ".arrow")

EXAMPLE = """\b
Examples:
  vexture map counties.gpkg --color income -o income.ktx2
  vexture map states.json roads.fgb --layer states --stroke 2km -o usa.ktx2
  vexture map parcels.parquet --where "area > 100" --color use --scale categories --crs EPSG:28992 -o parcels.ktx2
"""


@click.command(epilog=EXAMPLE)
@click.argument("sources", metavar="SOURCE...", nargs=-1, required=True, type=PATH)
@click.option("-o", "--output", metavar="FILE.ktx2", required=True, type=PATH, help="Texture to write.")
@click.option("--layer", metavar="NAME", help="Layer, of sources with several.")
@click.option("--where", metavar="SQL", help='Only features of which this holds: "population > 1000".')
@click.option("--id", metavar="COLUMN", help="Names of the features.  [default: the column id, or their numbers]")
@click.option("--columns", metavar="A,B,...", help="Attributes that the table keeps.  [default: all]")
@click.option(
    "--table", metavar="FILE", type=PATH, help="Table of attributes, .parquet or .arrow.  [default: FILE.parquet]"
)
@click.option("--crs", metavar="EPSG:N", default="EPSG:3857", show_default=True, help="Reference system of the map.")
@click.option("--source-crs", metavar="EPSG:N", help="That of the sources, if a file does not say it.")
@click.option("--color", "--colour", metavar="COLUMN", help="Attribute that colours show.")
@click.option(
    "--scale", type=click.Choice(["auto", "quantiles", "equal", "continuous", "categories"]), default="auto",
    show_default=True, help="auto: quantiles of numbers, categories of texts.",
)  # fmt: skip
@click.option("--classes", metavar="N", type=int, default=5, show_default=True, help="Number of classes.")
@click.option("--breaks", metavar="A,B,...", help="Values between classes, in place of --scale.")
@click.option("--palette", metavar="NAME", help="Palette of cmap.  [default: viridis; okabeito for categories]")
@click.option("--no-data", metavar="COLOR", type=Colour(), help="Colour without a value.  [default: light grey]")
@click.option("--order", metavar="COLUMN", help="The greatest lies on top; area: the smallest.  [default: the last]")
@click.option(
    "--snap", metavar="S", type=float, help="Borders that differ by less become one.  [default: 3e-6 of the map]"
)
@click.option(
    "--gaps", metavar="W", type=float, default=0.0, help="Close gaps so narrow, in units of --crs, and overlaps."
)
@click.option("--stroke", metavar="WIDTH", default="1.5px", show_default=True, help="Width of lines: 500m, 2km, 1.5px.")
@click.option("--symbol", metavar="FILE.svg", type=PATH, help="What stands at points.  [default: a disc]")
@click.option("--symbol-size", metavar="WIDTH", default="8px", show_default=True, help="Its width: 500m, 8px.")
@click.option(
    "--pixels", metavar="N", type=float, default=1000.0, show_default=True, help="Longer side of a map for px."
)
@click.option("--name", help="Name of the map.  [default: that of the output]")
@tolerance_option
@strict_option
@click.option("--json", "as_json", is_flag=True, help="Facts about the map, its legend among them, as JSON.")
@click.option("-q", "--quiet", is_flag=True, help="Say nothing but errors.")
def map(
    sources: tuple[Path, ...],
    output: Path,
    table: Path | None,
    name: str | None,
    tolerance: Any,
    strict: bool,
    as_json: bool,
    quiet: bool,
    **options: Any,
) -> None:
    """Convert polygons, lines and points into a map that can be recoloured and asked.

    GeoPackage, GeoParquet, FlatGeobuf, shapefile, GeoJSON or TopoJSON. The elements of the texture are the features, by
    their names; their attributes are in a table beside it. Later sources lie over earlier ones.
    """
    with one_line():
        place = _table_of(output, table)
        for source in sources:
            for target in (output, place):
                if target.exists() and source.exists() and target.samefile(source):
                    raise ParameterError(f"{target}: it is a source itself; give another `output`, or `table`")
        from vexture.cartography.convert import convert_map

        made = convert_map(sources, name or output.stem, tolerance=tolerance, **_parsed(options))
        if strict and any(note.is_loss for note in made.notes):
            raise SourceError(f"{made.warning}; `strict` accepts no such note; correct the source")
        size = made.save(output, place)
        if made.warning and not quiet:
            say(f"warning: {made.warning}")
        if as_json:
            import json

            click.echo(json.dumps(made.facts() | {"files": [str(output), str(place)], "bytes": size}, indent=2))
        elif not quiet:
            click.echo(f"{output}: {counted(len(made.table), 'feature')}, {size} bytes; attributes in {place}")


def _table_of(output: Path, table: Path | None) -> Path:
    if output.suffix.lower() != PACKED_SUFFIX:
        raise ParameterError(f"`output` {output}: textures are KTX2 files; name one that ends in {PACKED_SUFFIX}")
    place = output.with_suffix(TABLES[0]) if table is None else table
    if place.suffix.lower() not in TABLES:
        raise ParameterError(f"`table` {place}: tables are {' or '.join(TABLES)}; name one that ends so")
    return place


def _parsed(options: dict[str, Any]) -> dict[str, Any]:
    """Options whose texts are lists of numbers or names, and colours."""
    given = dict(options)
    if given["breaks"] is not None:
        try:
            given["breaks"] = tuple(float(text) for text in given["breaks"].split(","))
        except ValueError:
            raise ParameterError(f"`breaks` {given['breaks']!r} are no numbers A,B,...") from None
    if given["columns"] is not None:
        given["columns"] = [text.strip() for text in given["columns"].split(",") if text.strip()]
    if given["no_data"] is not None:
        *premultiplied, alpha = given["no_data"]
        given["no_data"] = (*(part / alpha if alpha else 0.0 for part in premultiplied), alpha)
    return {key: value for key, value in given.items() if value is not None}
