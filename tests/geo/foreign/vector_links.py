"""Files of features that lead elsewhere, in formats of XML, databases and zips; writers as in `links`."""

import sqlite3
import warnings
import zipfile
from contextlib import closing

import numpy as np
import pyogrio
import shapely
from links import pipeline, text, virtual_layer
from outside import BOX

PLACE = "<Polygon><outerBoundaryIs><LinearRing><coordinates>4,52 6,52 6,53 4,52</coordinates></LinearRing>"
PLACE += "</outerBoundaryIs></Polygon>"


def kml(folder, body, before="", name="a.kml"):
    return text(
        folder,
        name,
        f'{before}<kml xmlns="http://www.opengis.net/kml/2.2" xmlns:xlink="http://www.w3.org/1999/xlink"><Document>'
        f"{body}<Placemark><name>own</name>{PLACE}</Placemark></Document></kml>",
    )


def network_link(href):
    return f"<NetworkLink><Link><href>{href}</href></Link></NetworkLink>"


def zip_files(folder, **files):
    with zipfile.ZipFile(folder / "a.kmz", "w") as archive:
        for name, content in files.items():
            archive.writestr(name.replace("_", "."), content)
    return folder / "a.kmz"


def kmz(folder, href):
    main = kml(folder, network_link(href)).read_text()
    return zip_files(folder, doc_kml=main, other_kml=main)


def gpx(folder, body, before=""):
    head = f'{before}<gpx xmlns="http://www.topografix.com/GPX/1/1" version="1.1">'
    return text(folder, "a.gpx", f'{head}{body}<wpt lat="52" lon="4"><name>own</name></wpt></gpx>')


def gml(folder, place="", schema="", srs="EPSG:28992"):
    """A collection of one square, and of a feature with another place."""
    box = (
        f'<gml:Polygon srsName="{srs}"><gml:exterior><gml:LinearRing><gml:posList>0 0 9 0 9 9 0 0</gml:posList>'
        "</gml:LinearRing></gml:exterior></gml:Polygon>"
    )
    return text(
        folder,
        "a.gml",
        '<o:FeatureCollection xmlns:o="http://a/b" xmlns:gml="http://www.opengis.net/gml" '
        'xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
        f'xsi:schemaLocation="http://a/b {schema}"><gml:featureMember><o:t><o:g>{box}</o:g><o:n>1</o:n></o:t>'
        f"</gml:featureMember>{place}</o:FeatureCollection>",
    )


def elsewhere(href):
    return f'<gml:featureMember><o:t><o:g xlink:href="{href}"/><o:n>2</o:n></o:t></gml:featureMember>'


def spatialite(folder, *statements):
    path = folder / "a.sqlite"
    with warnings.catch_warnings(action="ignore"):
        pyogrio.raw.write(
            path, shapely.to_wkb(np.array([BOX], object)), [np.array(["a"], object)], ["name"], driver="SQLite",
            geometry_type="Polygon", crs="EPSG:4326", SPATIALITE="YES", INIT_WITH_EPSG="NO", layer="one",
        )  # fmt: skip
    with closing(sqlite3.connect(path)) as base, base:
        base.execute("pragma writable_schema = on")
        for statement, *values in statements:
            base.execute(statement, values)
    return path


def geodatabase(folder):
    path = folder / "a.gdb"
    with warnings.catch_warnings(action="ignore"):
        pyogrio.raw.write(
            path, shapely.to_wkb(np.array([BOX], object)), [np.array(["a"], object)], ["name"], driver="OpenFileGDB",
            geometry_type="Polygon", crs="EPSG:4326", layer="one",
        )  # fmt: skip
    return path


def made_of(folder, using):
    sql = f"create virtual table vt using {using}"
    insert = "insert into sqlite_master (type, name, tbl_name, rootpage, sql) values ('table', 'vt', 'vt', 0, ?)"
    return spatialite(folder, (insert, sql))


REFUSED = {
    "KML with a DTD": lambda f, o: kml(f, "", f'<!DOCTYPE kml SYSTEM "{o["secret.dtd"]}">'),
    "KML with an entity elsewhere": lambda f, o: kml(
        f, "<name>&a;</name>", f'<!DOCTYPE kml [<!ENTITY a SYSTEM "{o["secret.csv"]}">]>'
    ),
    "GPX with a DTD at an address": lambda f, o: gpx(f, "", f'<!DOCTYPE gpx SYSTEM "{o.url}">'),
    "GML with a system in a file": lambda f, o: gml(f, srs=o["secret.wkt"]),
    "GML with the address of its system": lambda f, o: gml(f, srs=o.url),
    "SpatiaLite with a table of texts": lambda f, o: made_of(f, f"VirtualText('{o['secret.csv']}', UTF-8, 1)"),
    "SpatiaLite with a table of shapes": lambda f, o: made_of(f, f"VirtualShape('{o['secret']}', UTF-8, 4326)"),
    "SpatiaLite with a table of GDAL": lambda f, o: made_of(f, f"VirtualOGR('{o['secret.geojson']}')"),
    "SpatiaLite with a view on a file": lambda f, o: spatialite(
        f, (f"create view v as select BlobFromFile('{o['secret.bin']}') as a",)
    ),
    "SpatiaLite with a view on XML": lambda f, o: spatialite(
        f, (f"create view v as select XB_LoadXML('{o.url}') as a",)
    ),
    "SpatiaLite with a system that is a pipeline": lambda f, o: spatialite(
        f, ("update spatial_ref_sys set srtext = ?", pipeline(o["secret.gsb"]))
    ),
    "a zip of a virtual layer": lambda f, o: zip_files(f, a_json=virtual_layer(o["secret.geojson"])),
    "a zip of what has a DTD": lambda f, o: zip_files(
        f, a_gpx=gpx(f, "", f'<!DOCTYPE gpx SYSTEM "{o["secret.dtd"]}">').read_text()
    ),
}
"""Those that are refused."""

NOTED = {
    "KML with a link to a file": lambda f, o: kml(f, network_link(o["secret.kml"])),
    "KML with a link to a file beside its folder": lambda f, o: kml(f, network_link("../outside/secret.kml")),
    "KML with a link to an address": lambda f, o: kml(f, network_link(o.url)),
    "KMZ with a link to a file": lambda f, o: kmz(f, o["secret.kml"]),
    "KMZ with a link to a file beside its folder": lambda f, o: kmz(f, "../outside/secret.kml"),
    "KMZ with a link to an address": lambda f, o: kmz(f, o.url),
    "GML with a place in a file": lambda f, o: gml(f, elsewhere(f"{o['secret.kml']}#a")),
    "GML with a place at an address": lambda f, o: gml(f, elsewhere(f"{o.url}#a")),
}
"""Those that are read, with a note about what is not."""

IGNORED = {
    "KML with a style in a file": lambda f, o: kml(
        f, f"<Placemark><styleUrl>{o['secret.kml']}#s</styleUrl>{PLACE}</Placemark>"
    ),
    "KML with a style at an address": lambda f, o: kml(
        f, f"<Placemark><styleUrl>{o.url}#s</styleUrl>{PLACE}</Placemark>"
    ),
    "KML with a picture": lambda f, o: kml(
        f, f"<GroundOverlay><Icon><href>{o['secret.png']}</href></Icon></GroundOverlay>"
    ),
    "GPX with a link": lambda f, o: gpx(f, f'<wpt lat="52" lon="5"><link href="{o.url}"/></wpt>'),
    "GML with a schema in a file": lambda f, o: gml(f, schema=o["secret.xsd"]),
    "GML with a schema beside its folder": lambda f, o: gml(f, schema="../outside/secret.xsd"),
    "GML with a schema at an address": lambda f, o: gml(f, schema=f"{o.url}?request=DescribeFeatureType&amp;a=.xsd"),
}
"""Those of which what is elsewhere has no shapes."""
