"""What the page of a flood is told."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from vexture.flood.relief import Relief
from vexture.flood.shore import Shore
from vexture.geo.crs import system
from vexture.geo.extent import Frame

__all__ = ["Flood", "Note", "scene"]


class Note(NamedTuple):
    """What people should know about what they see, and what who makes the page can do about it."""

    text: str
    remedy: str


@dataclass(frozen=True, slots=True, eq=False)
class Flood:
    """All of a page but its water.

    Parameters
    ----------
    title : str
    frame : Frame
    ground : bytes
        Picture of the ground over the frame, encoded.
    relief : Relief
    fold : bytes or None
        How the shoreline moves, as a file; None if it does not.
    shore : Shore or None
        Where to stand.
    notes : tuple of Note
    """

    title: str
    frame: Frame
    ground: bytes
    relief: Relief
    fold: bytes | None
    shore: Shore | None
    notes: tuple[Note, ...]


def scene(
    flood: Flood, steps: Sequence[str | Mapping[str, Any]], prefix: str, ground: str, fold: str | None
) -> dict[str, Any]:
    """Everything that the page needs, ready for JSON.

    Parameters
    ----------
    flood : Flood
    steps : sequence
        Names of the shapes on a server, or manifests that hold them.
    prefix : str
        Further shapes of this name, or whose names begin with it and a slash, are further steps.
    ground, fold : str
        Addresses of the picture and of the file.
    """
    frame, shore = flood.frame, flood.shore
    return {
        "title": flood.title,
        "steps": list(steps),
        "prefix": prefix,
        "frame": {
            "box": list(frame.box),
            "to_source": frame.to_source.ravel().tolist(),
            "metres": list(frame.metres),
            "crs": frame.crs,
            "bounds": list(frame.bounds),
            "geographic": system(frame.crs).is_geographic,
        },
        "ground": ground,
        "relief": flood.relief.as_json(),
        "fold": fold,
        "shore": None if shore is None else {"place": list(shore.place), "seaward": list(shore.seaward)},
        "notes": [note.text for note in flood.notes],
    }
