"""Databases of features: tables, views and systems that lead out of them are refused with their names."""

import sqlite3
from contextlib import closing

import pytest

from vexture.base.errors import SourceError
from vexture_geo.vector.vector_files import APPLICATION, GEOPACKAGE, SPATIALITE, as_geopackage, refuse_links_of_database

TABLES = (
    "CREATE TABLE gpkg_contents (table_name TEXT)",
    "CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT, definition TEXT)",
    "INSERT INTO gpkg_spatial_ref_sys VALUES ('WGS 84', 'GEOGCRS[\"WGS 84\"]')",
)


@pytest.fixture
def database(tmp_path):
    """A function that writes a GeoPackage after some further statements, as far as it matters here."""

    def write(*statements, tables=TABLES):
        path = tmp_path / f"{len([*tmp_path.iterdir()])}.gpkg"
        with closing(sqlite3.connect(path)) as base, base:
            for statement in (*tables, *statements):
                base.execute(statement)
        return path

    return write


def added(sql):
    """A statement that puts another into the schema, of a table whose module is not here."""
    return ("PRAGMA writable_schema = ON", f"INSERT INTO sqlite_master VALUES ('table', 'far', 'far', 0, '{sql}')")


def test_the_format_is_told_by_its_tables(database):
    path = database("CREATE VIRTUAL TABLE rtree_a USING rtree(id, minx, maxx)", "CREATE VIEW land AS SELECT 1")
    assert refuse_links_of_database(path) == GEOPACKAGE
    assert refuse_links_of_database(path.read_bytes()) == GEOPACKAGE
    assert refuse_links_of_database(database(tables=("CREATE TABLE geometry_columns (a)",))) == SPATIALITE
    with pytest.raises(SourceError, match="but no GeoPackage or SpatiaLite"):
        refuse_links_of_database(database(tables=("CREATE TABLE other (a)",)))


@pytest.mark.parametrize("start", ["CREATE VIRTUAL TABLE", "create/**/virtual -- ,\n table"])
def test_tables_in_other_files_are_refused(database, start):
    path = database(*added(f'{start} far USING VirtualText("/secret/a.csv")'))
    with pytest.raises(SourceError, match=r"its table 'far' is made of .*/secret/a\.csv"):
        refuse_links_of_database(path)


def test_functions_that_read_files_are_refused(database):
    path = database("CREATE VIEW leak AS SELECT BlobFromFile ('/secret/key')")
    with pytest.raises(SourceError, match=r"its view 'leak' reads .*/secret/key"):
        refuse_links_of_database(path)


def test_systems_that_name_files_are_refused(database):
    path = database("INSERT INTO gpkg_spatial_ref_sys VALUES ('x', '+proj=longlat +nadgrids=/secret/grid')")
    with pytest.raises(SourceError, match="its reference system names '/secret/grid'"):
        refuse_links_of_database(path)
    with pytest.raises(SourceError, match="its spatial_ref_sys is a view rather than a table"):
        refuse_links_of_database(database("CREATE VIEW spatial_ref_sys AS SELECT 1"))


def test_damage_is_one_line(database):
    with pytest.raises(SourceError, match="its database is damaged"):
        refuse_links_of_database(b"SQLite format 3\0" + bytes(200))


def test_a_geopackage_gets_an_identifier_and_keeps_its_own(database):
    content = database().read_bytes()
    assert as_geopackage(content)[APPLICATION] == b"GP10"
    assert as_geopackage(content).replace(b"GP10", bytes(4)) == content
    own = content[:68] + b"GPKG" + content[72:]
    assert as_geopackage(own) is own
