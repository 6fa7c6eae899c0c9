"""Sources that lead elsewhere, each by another way of its format; each writer returns what a reader is given."""

import json
import re
import sqlite3
from contextlib import closing
from pathlib import Path

import h5py
import numpy as np
import pyogrio
import shapely
from outside import BOX, SIDE, WKT, Outside, raster

WKT2 = 'GEOGCRS["s",DATUM["a",ELLIPSOID["b",6378137,298]],PRIMEM["Greenwich",0]]'
RING = [[4, 52], [6, 52], [6, 53], [4, 53], [4, 52]]


def plain():
    values = np.zeros((SIDE, SIDE), np.float32)
    values[10:20, 10:20] = 1.0
    return values


def overview(folder, link):
    return raster(folder / "a.tif", plain(), tags={"OVERVIEWS": {"OVERVIEW_FILE": link}})


def beside(folder, ending, text):
    path = raster(folder / "a.tif", plain())
    (folder / f"a.tif{ending}").write_text(text)
    return path


def pam(folder, text):
    return beside(folder, ".aux.xml", f"<PAMDataset>{text}</PAMDataset>")


def virtual_raster(link):
    half = SIDE // 2
    return (
        f'<VRTDataset rasterXSize="{half}" rasterYSize="{half}"><SRS>EPSG:28992</SRS><GeoTransform>0,20,0,22000,0,-20'
        '</GeoTransform><VRTRasterBand dataType="Float32" band="1"><SimpleSource>'
        f'<SourceFilename relativeToVRT="0">{link}</SourceFilename><SourceBand>1</SourceBand></SimpleSource>'
        "</VRTRasterBand></VRTDataset>"
    )


def overview_that_names(folder, link):
    path = raster(folder / "a.tif", plain())
    raster(folder / "a.tif.ovr", plain()[::2, ::2], placed=False, tags={"OVERVIEWS": {"OVERVIEW_FILE": link}})
    return path


def overview_of_overview(folder, link):
    path = raster(folder / "a.tif", plain())
    raster(folder / "a.tif.ovr", plain()[::2, ::2], placed=False)
    (folder / "a.tif.ovr.ovr").write_text(virtual_raster(link))
    return path


def places_elsewhere(folder, link):
    steps = dict.fromkeys(("PIXEL_OFFSET", "LINE_OFFSET"), "0") | dict.fromkeys(("PIXEL_STEP", "LINE_STEP"), "1")
    about = {"X_DATASET": link, "Y_DATASET": link, "X_BAND": "1", "Y_BAND": "1", **steps}
    return raster(folder / "a.tif", plain(), placed=False, tags={"GEOLOCATION": about})


def netcdf(path, kind, link, group="", system="EPSG:28992"):
    """A file of depths of which some are elsewhere, or that has a name for what is elsewhere."""
    with h5py.File(path, "w") as file:
        file.attrs["crs"] = system
        about = file.create_dataset("crs", data=1)
        about.attrs.update(spatial_ref=system, grid_mapping_name="latitude_longitude")
        axes = [file.create_dataset(name, data=np.arange(count) * 1.0) for name, count in (("y", 40), ("x", 100))]
        for name, axis in zip("yx", axes, strict=True):
            axis.make_scale(name)
            axis.attrs["standard_name"] = f"projection_{name}_coordinate"
        if kind == "external":
            depth = file.create_dataset("depth", shape=(40, 100), dtype="u1", external=[(link, 0, 4000)])
        elif kind == "virtual":
            layout = h5py.VirtualLayout(shape=(40, 100), dtype="u1")
            layout[:] = h5py.VirtualSource(link, "d", shape=(40, 100))
            depth = file.create_virtual_dataset("depth", layout)
        else:
            depth = file.create_dataset("depth", data=np.full((40, 100), 9, "u1"))
        if kind == "link":
            inner = file.require_group(group) if group else file
            inner["secret"] = h5py.ExternalLink(link, "d")
        if kind == "referred":  # by an attribute alone, and by no name
            hidden = file.create_dataset("hidden", shape=(40, 100), dtype="u1", external=[(link, 0, 4000)])
            to_hidden = np.empty(2, object)
            to_hidden[:] = [np.array([hidden.ref], h5py.ref_dtype) for _ in "yx"]
            depth.attrs.create("DIMENSION_LIST", to_hidden, dtype=h5py.vlen_dtype(h5py.ref_dtype))
            at = h5py.h5o.get_info(hidden.id).addr
        else:
            for dimension, axis in enumerate(axes):
                depth.dims[dimension].attach_scale(axis)
        depth.attrs.update(units="m", standard_name="sea_floor_depth_below_sea_surface", grid_mapping="crs")
    if kind == "referred":
        with path.open("r+b") as file:  # two names, of which there is one: what is left has none
            file.seek(at + 4)
            file.write((2).to_bytes(4, "little"))
        with h5py.File(path, "r+") as file:
            del file["hidden"]
    return path


def name_crs(path, name):
    with h5py.File(netcdf(path, "plain", ""), "r+") as file:
        del file.attrs["crs"], file["crs"].attrs["spatial_ref"]
        file["crs"].attrs["geographic_crs_name"] = name
    return path


def partition(folder, link):
    netcdf(folder / "run_0000_map.nc", "external", link)
    return netcdf(folder / "run_0001_map.nc", "plain", link)


def geojson(folder, **members):
    feature = {"type": "Feature", "properties": {"a": 1}, "geometry": {"type": "Polygon", "coordinates": [RING]}}
    path = folder / "a.geojson"
    path.write_text(json.dumps({**members, "type": "FeatureCollection", "features": [feature]}))
    return path


def crs_of_geojson(folder, kind, **properties):
    return geojson(folder, crs={"type": kind, "properties": properties})


def crs_in_disguise(folder, url):
    """A member `crs` of a geometry, and the word that makes it a link, in other letters."""
    path = geojson(folder)
    key = r'"\u0063RS": {"type": "li\u006ek", "properties": {"href": "URL"}}, "coordinates"'.replace("URL", url)
    path.write_text(path.read_text().replace('"coordinates"', key))
    return path


def text(folder, name, content):
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def virtual_layer(link):
    return (
        f"<OGRVRTDataSource><OGRVRTLayer name='secret'><SrcDataSource relativeToVRT='0'>{link}</SrcDataSource>"
        "</OGRVRTLayer></OGRVRTDataSource>"
    )


def commands(link):
    line = f"gdal vector pipeline ! read {link} ! write streamed_file --output-format stream"
    return json.dumps({"type": "gdal_streamed_alg", "command_line": line})


def with_grid(link):
    return WKT.replace("298]", f'298],EXTENSION["PROJ4_GRIDS","{link}"]')


def with_list(link):
    return WKT[:-1] + f',EXTENSION["PROJ4","+init={link}:1"]]'


def written(path, crs="EPSG:4326"):
    pyogrio.raw.write(
        path, shapely.to_wkb(np.array([BOX], object)), [np.array(["a"], object)], ["name"], geometry_type="Polygon",
        crs=crs, **({"layer": "one"} if path.suffix == ".gpkg" else {}),
    )  # fmt: skip
    return path


def shapefile(folder, prj):
    path = written(folder / "a.shp")
    path.with_suffix(".prj").write_text(prj)
    return path


def flatgeobuf(folder, system):
    """A file whose system GDAL would write otherwise: in place of a name that is as long."""
    name = "A" * 400
    path = written(folder / "a.fgb", WKT.replace("secret", name))
    content = path.read_bytes()
    start = content.index(b"GEOG")
    end = content.index(b"\0", start)
    path.write_bytes(content[:start] + system.encode().ljust(end - start) + content[end:])
    return path


def in_lines(path):
    feature = json.dumps(json.loads(re.sub(r'"\\u0063RS".*?}}, ', "", path.read_text()))["features"][0])
    link = re.search(r'"\\u0063RS".*?}}', path.read_text())[0]
    path.write_text(f"{feature}\n" + feature.replace('"coordinates"', f'{link}, "coordinates"') + "\n")
    return path


def pipeline(link):
    """A projected system of which the projection is a pipeline of PROJ."""
    return (
        f'PROJCRS["a",BASE{WKT2[:-1]}],CONVERSION["b",METHOD["PROJ-based operation method: +proj=pipeline +step '
        f'+proj=gridshift +grids={link} +step +proj=merc"]],CS[Cartesian,2],AXIS["x",east],AXIS["y",north],'
        'LENGTHUNIT["m",1]]'
    )


def geopackage(folder, *statements):
    path = written(folder / "a.gpkg")
    with closing(sqlite3.connect(path)) as base, base:
        base.execute("pragma writable_schema = on")
        for (trigger,) in base.execute("select name from sqlite_master where type = 'trigger'").fetchall():
            base.execute(f'drop trigger "{trigger}"')
        for statement, *values in statements:
            base.execute(statement, values)
    return path


def table_elsewhere(folder, using):
    return geopackage(
        folder,
        ("insert into sqlite_master (type, name, tbl_name, rootpage, sql) values ('table', 'vt', 'vt', 0, ?)",
         f"create /* */ virtual table vt using {using}"),
        ("insert into gpkg_contents (table_name, data_type, identifier) values ('vt', 'attributes', 'vt')",),
    )  # fmt: skip


def view(folder, expression):
    return geopackage(
        folder,
        (f"create view v as select fid, geom, {expression} as name from one",),
        ("insert into gpkg_contents (table_name, data_type, identifier, srs_id) values ('v', 'features', 'v', 4326)",),
        ("insert into gpkg_geometry_columns values ('v', 'geom', 'POLYGON', 4326, 0, 0)",),
        ("delete from gpkg_geometry_columns where table_name = 'one'",),
        ("delete from gpkg_contents where table_name = 'one'",),
    )


def system(folder, definition):
    change = "update gpkg_spatial_ref_sys set definition = ?, organization = 'NONE', organization_coordsys_id = 99"
    return geopackage(folder, (f"{change} where srs_id = 4326", definition))


def geoparquet(folder, link):
    import pyarrow as pa
    import pyarrow.parquet as pq

    crs = json.loads(json.dumps(_bound(link)))
    geo = {"version": "1.0.0", "primary_column": "geometry", "columns": {"geometry": {"encoding": "WKB", "crs": crs}}}
    table = pa.table({"geometry": [shapely.to_wkb(BOX)]}).replace_schema_metadata({"geo": json.dumps(geo)})
    pq.write_table(table, folder / "a.parquet")
    return folder / "a.parquet"


def _bound(link):
    import pyproj

    return pyproj.CRS.from_user_input(f"+proj=longlat +ellps=bessel +nadgrids={link} +type=crs").to_json_dict()


def svg(folder, body, before=""):
    head = f'{before}<svg xmlns="http://www.w3.org/2000/svg" xmlns:x="http://www.w3.org/1999/xlink" viewBox="0 0 9 9">'
    return text(folder, "a.svg", f'{head}{body}<rect width="4" height="4"/></svg>')


def gltf(folder, **members):
    whole = {"asset": {"version": "2.0"}, "materials": [{"name": "Sign"}], **members}
    return text(folder, "a.gltf", json.dumps(whole))


DEPTHS = {
    "a GeoTIFF whose overview is another file": lambda f, o: overview(f, o["secret.tif"]),
    "a GeoTIFF whose overview is an address": lambda f, o: overview(f, f"/vsicurl/{o.url}.tif"),
    "a GeoTIFF whose .aux.xml names its overview": lambda f, o: pam(
        f, f'<Metadata domain="OVERVIEWS"><MDI key="OVERVIEW_&#70;ILE">{o["secret.tif"]}</MDI></Metadata>'
    ),
    "a GeoTIFF whose .aux.xml has a list of systems": lambda f, o: pam(f, f"<SRS>+init={o['secret.init']}:1</SRS>"),
    "a GeoTIFF whose .ovr is a virtual raster": lambda f, o: beside(f, ".ovr", virtual_raster(o["secret.tif"])),
    "a GeoTIFF whose .msk is a virtual raster": lambda f, o: beside(f, ".msk", virtual_raster(o["secret.tif"])),
    "a GeoTIFF whose .ovr names its overview": lambda f, o: overview_that_names(f, o["secret.tif"]),
    "a GeoTIFF whose .ovr has an .ovr": lambda f, o: overview_of_overview(f, o["secret.tif"]),
    "a GeoTIFF with places elsewhere": lambda f, o: places_elsewhere(f, o["secret.tif"]),
    "NetCDF with external storage": lambda f, o: netcdf(f / "a.nc", "external", o["secret.bin"]),
    "NetCDF with a virtual dataset": lambda f, o: netcdf(f / "a.nc", "virtual", o["secret.h5"]),
    "NetCDF with an external link": lambda f, o: netcdf(f / "a.nc", "link", o["secret.h5"]),
    "NetCDF with an external link in a group": lambda f, o: netcdf(f / "a.nc", "link", o["secret.h5"], "one/two"),
    "NetCDF with a dimension elsewhere": lambda f, o: netcdf(f / "a.nc", "referred", o["secret.bin"]),
    "NetCDF with a name in a list": lambda f, o: name_crs(f / "a.nc", f"+init={o['secret.init']}:1"),
    "a partition with external storage": lambda f, o: partition(f, o["secret.bin"]),
}
"""Depths, which `read_extent` reads, and servers of floods."""

ALONE = [
    way for way in DEPTHS if ".aux" not in way and ".ovr" not in way and ".msk" not in way and "partition" not in way
]
"""Those of one file, which can be sent to a server."""

AREAS = {
    "GeoJSON with a link to its system": lambda f, o: crs_of_geojson(f, "link", href=o.url, type="proj4"),
    "GeoJSON with the address of its system": lambda f, o: crs_of_geojson(f, "url", url=o.url),
    "GeoJSON with an address for a name": lambda f, o: crs_of_geojson(f, "name", name=o.url),
    "GeoJSON with a link in disguise": lambda f, o: crs_in_disguise(f, o.url),
    "GeoJSON with a file for a name": lambda f, o: crs_of_geojson(f, "name", name=o["secret.wkt"]),
    "GeoJSON with a list of systems": lambda f, o: crs_of_geojson(f, "name", name=f"+init={o['secret.init']}:1"),
    "GeoJSON with a grid": lambda f, o: crs_of_geojson(
        f, "name", name=f"+proj=longlat +ellps=bessel +nadgrids={o['secret.gsb']} +no_defs"
    ),
    "JSON that is commands of GDAL": lambda f, o: text(f, "a.json", commands(o["secret.geojson"])),
    "JSON that is a virtual layer": lambda f, o: text(
        f, "a.json", '{"a": "' + virtual_layer(o["secret.geojson"]) + '"}'
    ),
    "a FlatGeobuf that is a virtual layer": lambda f, o: text(
        f, "a.fgb", b"fgb\x03fgb" + virtual_layer(o["secret.geojson"]).encode()
    ),
    "a shapefile whose .prj has a grid": lambda f, o: shapefile(f, with_grid(o["secret.gsb"])),
    "a shapefile whose .prj has a list of systems": lambda f, o: shapefile(f, with_list(o["secret.init"])),
    "a FlatGeobuf with a grid": lambda f, o: flatgeobuf(f, with_grid(o["secret.gsb"])),
    "features in lines with a link in disguise": lambda f, o: in_lines(crs_in_disguise(f, o.url)),
    "a system that is a pipeline": lambda f, o: system(f, pipeline(o["secret.gsb"])),
    "a GeoPackage with a table of texts": lambda f, o: table_elsewhere(
        f, f"VirtualText('{o['secret.csv']}', UTF-8, 1)"
    ),
    "a GeoPackage with a table of shapes": lambda f, o: table_elsewhere(
        f, f"VirtualShape('{o['secret']}', UTF-8, 4326)"
    ),
    "a GeoPackage with a table of GDAL": lambda f, o: table_elsewhere(f, f"VirtualOGR('{o['secret.geojson']}')"),
    "a GeoPackage with a view on a pixel": lambda f, o: view(
        f, f"gdal_get_pixel_value('{o['secret.tif']}', 1, 'georef', 10, 10)"
    ),
    "a GeoPackage with a view on an address": lambda f, o: view(
        f, f"gdal_get_pixel_value('/vsicurl/{o.url}', 1, 'georef', 10, 10)"
    ),
    "a GeoPackage with a view on layers": lambda f, o: view(f, f"ogr_datasource_load_layers('{o['secret.geojson']}')"),
    "a GeoPackage with a view on a library": lambda f, o: view(f, f"load_extension('{o['secret.bin']}')"),
    "a GeoPackage with the address of its system": lambda f, o: system(f, o.url),
    "a GeoPackage with a system in a file": lambda f, o: system(f, o["secret.wkt"]),
    "a GeoPackage with a grid": lambda f, o: system(f, with_grid(o["secret.gsb"])),
    "a GeoPackage with a list of systems": lambda f, o: system(f, with_list(o["secret.init"])),
    "GeoParquet with a grid": lambda f, o: geoparquet(f, o["secret.gsb"]),
}
"""Features, which maps and tiles read; all but GeoParquet are areas, too."""

DRAWINGS = {
    "an SVG with an image beside its folder": lambda f, o: svg(f, '<image href="../outside/secret.svg"/>'),
    "an SVG with an image by its whole path": lambda f, o: svg(f, f'<image href="{o["secret.png"]}"/>'),
    "an SVG with an image by a file: URL": lambda f, o: svg(f, f'<image href="file://{o["secret.svg"]}"/>'),
    "an SVG with an image at an address": lambda f, o: svg(f, f'<image x:href="{o.url}"/>'),
    "an SVG that uses another": lambda f, o: svg(f, '<use x:href="../outside/secret.svg#secret"/>'),
    "an SVG that uses an address": lambda f, o: svg(f, f'<use href="{o.url}#secret"/>'),
    "an SVG that imports styles": lambda f, o: svg(
        f, f'<style>@import "../outside/secret.css"; @import url({o.url});</style>'
    ),
    "an SVG with a style sheet": lambda f, o: svg(
        f, "", f'<?xml-stylesheet href="{o["secret.css"]}"?><?xml-stylesheet href="{o.url}"?>'
    ),
    "an SVG with a font elsewhere": lambda f, o: svg(
        f, f'<style>@font-face {{font-family: A; src: url({o.url})}}</style><text font-family="A" y="9">a</text>'
    ),
    "an SVG with paint elsewhere": lambda f, o: svg(
        f, f'<rect width="9" height="9" fill="url({o.url}#a)" mask="url(../outside/secret.svg#secret)"/>'
    ),
    "an SVG with a filter's image": lambda f, o: svg(
        f, f'<filter id="f"><feImage href="{o.url}"/></filter><rect width="9" height="9" filter="url(#f)"/>'
    ),
    "an SVG that includes": lambda f, o: svg(
        f, f'<i:include xmlns:i="http://www.w3.org/2001/XInclude" href="{o["secret.svg"]}"/>'
    ),
    "an SVG with a DTD elsewhere": lambda f, o: svg(f, "", f'<!DOCTYPE svg SYSTEM "{o["secret.dtd"]}">'),
    "an SVG with a DTD at an address": lambda f, o: svg(f, "", f'<!DOCTYPE svg SYSTEM "{o.url}">'),
    "an SVG with an entity elsewhere": lambda f, o: svg(
        f, "<text>&a;</text>", f'<!DOCTYPE svg [<!ENTITY a SYSTEM "{o["secret.csv"]}">]>'
    ),
}
"""Drawings, which `read` reads."""

MODELS = {
    "a model with a buffer at an address": lambda f, o: gltf(f, buffers=[{"byteLength": 4, "uri": o.url}]),
    "a model with a buffer beside its folder": lambda f, o: gltf(
        f, buffers=[{"byteLength": 4, "uri": "..%2foutside/secret.bin"}]
    ),
    "a model with an image by its whole path": lambda f, o: gltf(f, images=[{"uri": f"file://{o['secret.png']}"}]),
}
"""Models, which `vexture gltf` reads."""

RELIEFS = {
    "a relief that is a virtual raster": lambda f, o: text(f, "a.vrt", virtual_raster(o["secret.tif"])),
    "a relief that is a virtual raster by another name": lambda f, o: text(f, "a.tif", virtual_raster(o["secret.tif"])),
    "a relief with places elsewhere": lambda f, o: places_elsewhere(f, o["secret.tif"]),
    "a relief with an external link": lambda f, o: netcdf(f / "a.nc", "external", o["secret.bin"]),
    "a relief with a grid": lambda f, o: netcdf(f / "a.nc", "plain", "", system=with_grid(o["secret.gsb"])),
    "a relief that is a service": lambda f, o: text(
        f, "a.xml", f"<GDAL_WMS><Service name='TMS'><ServerUrl>{o.url}</ServerUrl></Service></GDAL_WMS>"
    ),
}
"""Heights and pictures of the ground, which `vexture flood` reads."""


def make_source(ways: dict[str, object], name: str, folder: Path, outside: Outside) -> Path:
    """Make the source of a name, in a folder of its own beside that of the secrets."""
    path = ways[name](folder, outside)
    outside.take_accesses()  # by who made it
    return path
