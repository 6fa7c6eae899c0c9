"""The command `map`."""

from collections.abc import Sequence
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, Final

import click

from vexture.base.errors import ParameterError, format_count
from vexture.base.notes import Note
from vexture.cli.messages import echo, note_facts, one_line, say_notes
from vexture.cli.options import PATH, read_stream
from vexture_geo.cli.colour_options import colour_options, columns_of, refuse_idle_colours, scale_of

if TYPE_CHECKING:
    from vexture_geo.maps import Map, MapLayer

TIMES: Final = ".times.json"
"""Suffix of the file of colours at each step."""

EXAMPLE = """\b
Examples:
  vexture map counties.gpkg --id GEOID --color population -o counties.ktx2
  vexture map counties.gpkg --id GEOID --time 'y*' -o years.ktx2
  vexture map land.fgb roads.fgb --stroke 1px --stroke 40m --crs EPSG:28992 -o delft.ktx2
"""

EACH: Final = "once for all sources, or once for each ('' for none)"


@click.command(epilog=EXAMPLE)
@click.argument("sources", metavar="SOURCE...", nargs=-1, required=True, type=PATH)
@click.option("-o", "--output", metavar="FILE.ktx2", required=True, type=PATH, help="The texture to write.")
@click.option("--layer", metavar="NAME", multiple=True, help=f"Layer of a file that has several; {EACH}.")
@click.option("--where", metavar="SQL", multiple=True, help="Condition on attributes, such as \"kind = 'town'\".")
@click.option("--crs", metavar="EPSG:N", default="EPSG:3857", show_default=True, help="Reference system of the map.")
@click.option("--source-crs", metavar="EPSG:N", multiple=True, help="That of a source that does not say it.")
@click.option("--id", "ids", metavar="COLUMN", multiple=True, help="Column of ids.  [default: the format's own]")
@click.option("--columns", metavar="A,B,...", multiple=True, help="Attributes to keep in the table.  [default: all]")
@click.option("--color", "--colour", metavar="COLUMN", multiple=True, help="Attribute that colours show.")
@click.option(
    "--time", metavar="A,B,...|y*|TABLE", multiple=True,
    help="What colours show at each step: columns, or a Parquet, Arrow or CSV file of id, time and a value.",
)  # fmt: skip
@colour_options
@click.option("--fill", metavar="COLOR", multiple=True, help="One colour of a source.")
@click.option("--order", metavar="COLUMN", multiple=True, help="Which polygons are above.  [default: the smaller ones]")
@click.option("--stroke", metavar="500m|1.5px", multiple=True, help="Width of lines.  [default: 1px]")
@click.option(
    "--outline", metavar="COLOR", multiple=True, help="Borders of polygons, each drawn once.  [default: none]"
)
@click.option("--outline-width", metavar="500m|1.5px", multiple=True, help="Width of outlines.  [default: 1px]")
@click.option("--symbol", metavar="FILE", type=PATH, help="Drawing at points; a picture is traced.  [default: a dot]")
@click.option("--symbol-size", metavar="2km|8px", default="8px", show_default=True, help="Width of symbols.")
@click.option("--size", metavar="PX", type=int, default=1024, show_default=True, help="Map side for widths in px.")
@click.option("--snap", metavar="PART", type=float, help="Borders and gaps this near become one.  [default: 3e-6]")
@click.option("--tolerance", metavar="PART", type=float, help="Most that a border moves.  [default: 2e-5]")
@click.option("--restyle/--no-restyle", default=True, help="Whether features can be picked and recoloured.")
@click.option("--max-seconds", metavar="S", type=float, default=300.0, show_default=True, help="Most time.")
@click.option("--json", "as_json", is_flag=True, help="Print facts and the legend as JSON.")
def map(
    sources: tuple[Path, ...], output: Path, symbol: Path | None, table: str, as_json: bool, **options: Any
) -> None:
    """Convert geographic data into one texture and a table of attributes.

    SOURCE is a GeoPackage, SpatiaLite, FlatGeobuf, shapefile, FileGDB, KML, KMZ, GPX, GML, GeoJSON (also
    newline-delimited), TopoJSON, GeoParquet, Feather, or CSV with a column of WKT or two of coordinates. Several
    sources become layers, drawn in this order. Features are elements of the texture, named by their ids.
    """
    start = perf_counter()
    with one_line():
        from vexture.base.apart import apart
        from vexture.base.layout import PACKED_SUFFIX
        from vexture.texture.files import write_together
        from vexture_geo.vector.tables import check_targets

        if output.suffix.lower() != PACKED_SUFFIX:
            raise ParameterError(f"`output` {output}: textures are KTX2 files; name one that ends in {PACKED_SUFFIX}")
        beside = [*([] if table == "none" else [f".{table}"]), *([TIMES] if any(options["time"]) else [])]
        targets = [output, *(output.with_suffix(suffix) for suffix in beside)]
        check_targets(targets, sources)
        names = ", ".join(str(source) for source in sources)
        given = (sources, [read_stream(source) for source in sources], output, symbol, table, options)
        files, facts, notes = apart(_make_files, *given, name=names, seconds=options["max_seconds"])
        write_together(files)
        if as_json:
            import json

            click.echo(json.dumps(facts | {"notes": note_facts(notes)}, indent=2))
            return
        say_notes(output.name, notes)
        size = sum(len(content) for content in files.values())
        shown = ", ".join(facts["files"])
        echo(f"{shown}: {format_count(facts['features'], 'feature')}, {size} bytes, {perf_counter() - start:.1f} s")


def _make_files(
    sources: tuple[Path, ...],
    contents: list[bytes | None],
    output: Path,
    symbol: Path | None,
    table: str,
    options: dict[str, Any],
) -> tuple[dict[Path, bytes], dict[str, Any], tuple[Note, ...]]:
    """Make the files of a map, with facts about it and notes on what it leaves out."""
    from vexture.base.content import renaming
    from vexture.base.deadline import within
    from vexture_geo.maps import convert_map

    kept = {name: options[name] for name in ("crs", "snap", "size", "restyle", "max_seconds")}
    if options["tolerance"] is not None:
        kept["tolerance"] = options["tolerance"]
    with within(options["max_seconds"]), renaming({"times": "time"}):
        done = convert_map(_layers(sources, contents, symbol, options), name=output.stem, **kept)
    files = _files(output, done, table)
    facts: dict[str, Any] = {"name": output.stem, "crs": done.conversion.drawing.crs, "features": len(done.table)}
    facts |= {"files": [str(place) for place in files], "legend": list(done.legends)}
    return files, facts, done.conversion.notes


def _files(output: Path, done: "Map", table: str) -> dict[Path, bytes]:
    """Encode the texture, the table, and the colours of each step of time."""
    from vexture_geo.vector.tables import table_bytes

    files = {output: done.conversion.texture.to_ktx2()}
    if table != "none":
        files[output.with_suffix(f".{table}")] = table_bytes(done.table, table)
    if done.times is not None:
        import json

        files[output.with_suffix(TIMES)] = json.dumps(done.times, separators=(",", ":")).encode()
    return files


def _layers(
    sources: tuple[Path, ...], contents: list[bytes | None], symbol: Path | None, options: dict[str, Any]
) -> "list[MapLayer]":
    """Make the layers that options describe."""
    from vexture.base.notes import warn_of
    from vexture.conversion.reading import read_drawing
    from vexture_geo.maps import MapLayer, Times

    count = len(sources)
    drawn = None if symbol is None else read_drawing(symbol, for_outlines=True)
    if drawn is not None:
        warn_of(str(symbol), drawn.notes)
    each = {name: _each(options[name], count, name) for name in ("layer", "where", "source_crs", "columns", "color")}
    each |= {name: _each(options[name], count, name) for name in ("ids", "time", "fill", "order")}
    each |= {name: _each(options[name], count, name) for name in ("stroke", "outline", "outline_width")}
    if not any(each["color"] + each["time"]):
        refuse_idle_colours(options, "`color` or `time`")
    if any(each["outline_width"]) and not any(each["outline"]):
        width = next(filter(None, each["outline_width"]))
        raise ParameterError(f"`outline_width` {width}, but no outlines; give their colour by `outline`")
    layers = []
    for place, source in enumerate(sources):
        own = {name: values[place] for name, values in each.items()}
        columns, scale = columns_of(own["columns"]), None
        if own["color"] is not None and own["time"] is not None:
            raise ParameterError(f"{source}: colours show its `color` or its `time`; give one of them")
        if own["color"] is not None or own["time"] is not None:
            if own["fill"] is not None:
                raise ParameterError(
                    f"{source}: `fill` and colours by an attribute exclude each other; give '' for one"
                )
            scale = scale_of(own["color"] or "", options)
        times = None if own["time"] is None else Times(own["time"])
        shape: dict[str, Any] = {name: own[name] for name in ("fill", "order", "outline")}
        shape |= {
            "stroke": own["stroke"] or "1px",
            "outline_width": own["outline_width"] or "1px",
            "symbol": drawn,
            "symbol_size": options["symbol_size"],
        }
        chosen = (own["layer"], own["where"], own["source_crs"], own["ids"], columns, scale)
        content = contents[place]
        layers.append(MapLayer(source if content is None else content, *chosen, times=times, **shape))
    return layers


def _each(values: Sequence[str], count: int, name: str) -> list[str | None]:
    """Return the value of an option for each source."""
    if len(values) not in (0, 1, count):
        name = "id" if name == "ids" else name
        raise ParameterError(f"`{name}` is given {len(values)} times for {count} sources; give it once, or for each")
    every = [*values] * (count if len(values) == 1 else 1) if values else [""] * count
    return [value or None for value in every]
