"""Detect links from HDF5 files, and so NetCDF-4 files, to other files, which libraries follow silently.

A dataset can store its values elsewhere (external storage, virtual datasets), and a name in a group can refer to an
object elsewhere (external links). The NetCDF library follows all of these, but writes none.
"""

import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from vexture.base.content import NETCDF, start_of
from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, SourceError, printable, shorten_text
from vexture_geo.base.damage import netcdf_error

if TYPE_CHECKING:
    from h5py.h5d import DatasetID
    from h5py.h5g import GroupID
    from h5py.h5t import TypeID

HDF5: Final = NETCDF[-1]

SHOWN: Final = 80
"""Characters of a link in a message."""

ROOT: Final = b"/"

SAME: Final = "."
"""Name by which a virtual dataset refers to its own file."""


def refuse_links_of_netcdf(path: str | os.PathLike[str]) -> None:
    """Raise a `SourceError` that names the link if an HDF5 file refers to another; other kinds of NetCDF cannot.

    All objects are checked, even unused ones, because the NetCDF library visits all of them when it opens a file.
    """
    if not start_of(path).startswith(HDF5):
        return
    from h5py import h5f, h5g

    try:
        file = h5f.open(os.fsencode(Path(path).absolute()), h5f.ACC_RDONLY)
        try:
            _look_at_all(h5g.open(file, ROOT))
        finally:
            file.close()
    except (SourceError, LimitError):
        raise
    except Exception as error:  # h5py raises any type of exception for a damaged file
        raise netcdf_error(error, str(path)) from None


def _look_at_all(root: "GroupID") -> None:
    """Check a group and everything in it or referred to, each object once."""
    from h5py import h5d, h5g, h5o

    seen, left = set[int](), list[tuple[Any, str]]([(root, "")])
    while left:
        check_time()
        one, name = left.pop()
        address = int(h5o.get_info(one).addr)
        if address in seen:
            continue
        seen.add(address)
        left += [(each, f"{name} (referred to)") for each in _referenced_objects(one, name)]
        if isinstance(one, h5d.DatasetID):
            _refuse_elsewhere(one, name)
        elif isinstance(one, h5g.GroupID):
            left += _members(one, name)


def _members(group: "GroupID", parent: str) -> list[tuple[Any, str]]:
    """List the objects of a group without opening any external link."""
    from h5py import h5l, h5o

    names: list[bytes] = []
    group.links.iterate(names.append)
    found = []
    for raw in names:
        name = f"{parent}/{raw.decode(errors='replace')}".removeprefix("/")
        kind = group.links.get_info(raw).type
        if kind == h5l.TYPE_HARD:
            found.append((h5o.open(group, raw), name))
        elif kind == h5l.TYPE_EXTERNAL:
            _refuse(name, "is", group.links.get_val(raw)[0])
        elif kind != h5l.TYPE_SOFT:  # a soft link is another name in this file
            raise SourceError(f"{_format_text(name)!r} is a link of an unknown kind, {kind}; write the file without it")
    return found


def _refuse_elsewhere(dataset: "DatasetID", name: str) -> None:
    """Refuse a dataset whose values are stored in other files."""
    from h5py import h5d

    how = dataset.get_create_plist()
    if how.get_external_count():
        _refuse(name, "has its values", how.get_external(0)[0])
    if how.get_layout() == h5d.VIRTUAL:
        for number in range(how.get_virtual_count()):
            if how.get_virtual_filename(number) != SAME:
                _refuse(name, "has its values", how.get_virtual_filename(number))
    _refuse_references(dataset.get_type(), name)


def _referenced_objects(one: Any, name: str) -> Iterator[Any]:
    """Yield objects that an object's attributes refer to, such as the dimensions of a variable."""
    import h5py
    from h5py import h5a, h5r

    for number in range(h5a.get_num_attrs(one)):
        attribute = h5a.open(one, index=number)
        kind = attribute.get_type()
        _refuse_references(kind, name)
        inner = kind.get_super() if kind.get_class() == h5py.h5t.VLEN else kind
        if inner.get_class() != h5py.h5t.REFERENCE or not inner.equal(h5py.h5t.STD_REF_OBJ):
            continue
        values = h5py.Dataset(one).attrs if isinstance(one, h5py.h5d.DatasetID) else h5py.Group(one).attrs
        found = values[attribute.name]
        for value in [] if isinstance(found, h5py.Empty) else np.atleast_1d(np.asarray(found, object)).ravel():
            for reference in [value] if isinstance(value, h5py.Reference) else np.atleast_1d(value):
                if reference:
                    with suppress(ValueError, KeyError, RuntimeError):  # the object no longer exists for anyone
                        yield h5r.dereference(reference, one)


def _refuse_references(kind: "TypeID", name: str) -> None:
    """Refuse references except those into the file itself: newer kinds can hold the name of another file."""
    from h5py import h5t

    inside = (h5t.STD_REF_OBJ, h5t.STD_REF_DSETREG)
    left = [kind]
    while left:
        kind = left.pop()
        what = kind.get_class()
        if what == h5t.COMPOUND:
            left += [kind.get_member_type(number) for number in range(kind.get_nmembers())]
        elif what in (h5t.VLEN, h5t.ARRAY):
            left.append(kind.get_super())
        elif what == h5t.REFERENCE and not any(kind.equal(each) for each in inside):
            raise SourceError(
                f"{_format_text(name)!r} has references that can lead to other files, and no other file is read; "
                "write the file without them"
            )


def _refuse(name: str, relation: str, link: str | bytes) -> None:
    raise SourceError(
        f"{_format_text(name)!r} {relation} in another file, {_format_text(os.fsdecode(link))!r}, and no other file is "
        "read; write the values into this one, for instance by xarray's load() and to_netcdf()"
    )


def _format_text(text: str) -> str:
    return printable(shorten_text(text, SHOWN))
