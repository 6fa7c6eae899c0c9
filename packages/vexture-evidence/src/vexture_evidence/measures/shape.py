"""A drawing and its conversions, each made once, for tables and figures."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeAlias, cast

from vexture.base.errors import LimitError, SourceError
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import Conversion, Source, run, run_encoding
from vexture.texture.registry import DEFAULT
from vexture.thesis.layout import LIST_LIMIT

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing
    from vexture.texture.texture import Texture
    from vexture.thesis.texture import ThesisTexture

Made: TypeAlias = "Conversion[Texture | ThesisTexture]"
"""A conversion by one of `WAYS`."""

WAYS: Final[dict[str, dict[str, Any]]] = {
    "sampled": {"encoding": "thesis", "strategy": "sampled"},
    "direct": {"encoding": "thesis", "strategy": "direct"},
    "packed": {"encoding": "packed", "split": None},
}
"""Parameters of `vexture.convert`: the thesis's own conversion, ours to its encoding, and the packed encoding."""


def convert_by(source: Source, way: Mapping[str, Any]) -> Made:
    """Convert by one of `WAYS`, which may have more parameters of its encoding."""
    if way["encoding"] == DEFAULT:
        return run(source, Parameters(**{name: value for name, value in way.items() if name != "encoding"}))
    return cast("Made", run_encoding(source, **way))


MOST_FOR_SAMPLED: Final = 3000
"""Quads; if ``direct`` has more of them, ``sampled`` would take minutes."""

EXAMPLES: Final = Path(__file__).resolve().parents[5] / "examples" / "shapes"
"""The example drawings of the repository; they are not installed."""


def example(name: str) -> Path:
    """File of one of the example drawings.

    Raises
    ------
    SourceError
        If it is not there.

    Examples
    --------
    >>> example("duck").name
    'duck.svg'
    """
    path = EXAMPLES / f"{name}.svg"
    if not path.is_file():
        raise SourceError(f"{path}: no such example drawing; run `vexture report` from a clone of the repository")
    return path


def file_bytes(texture: "Texture | ThesisTexture") -> int:
    """Size of a texture's file, or of its pair of files.

    Examples
    --------
    >>> texture = ConvertedDrawing(example("duck")).way("direct").texture
    >>> file_bytes(texture) == sum(map(len, texture.to_png()))
    True
    """
    return sum(map(len, texture.files().values()))


class ConvertedDrawing:
    """A drawing and its conversions.

    Parameters
    ----------
    path : path
        File that `vexture.convert` reads.
    name : str, optional
        Name to show instead of the drawing's own.

    Examples
    --------
    >>> duck = ConvertedDrawing(example("duck"))
    >>> duck.name, duck.way("packed").texture.nbytes % 16
    ('duck', 0)
    """

    def __init__(self, path: Path, name: str | None = None) -> None:
        self.path = path
        self._name = name
        self._ways: dict[tuple[str, int | None], Made | LimitError] = {}

    @property
    def name(self) -> str:
        """The given name, or the name of the drawing."""
        return self._name or self.drawing.name

    @cached_property
    def drawing(self) -> "Drawing":
        """The drawing in normal form."""
        from vexture.conversion.reading import read

        return read(self.path)

    def way(self, way: str, bits: int | None = None) -> Made:
        """Convert by one of `WAYS`; `bits` applies to the encoding ``thesis`` and is 16 if None.

        Raises
        ------
        LimitError
            If the encoding cannot hold the drawing, or ``sampled`` would take minutes.
        """
        given = dict(WAYS[way])
        if given["encoding"] == "thesis":
            given["bits"] = bits or max(LIST_LIMIT)
        key = way, given.get("bits")
        if key not in self._ways:
            try:
                if way == "sampled":
                    self._check_sampled()
                self._ways[key] = self._with_source(convert_by(self.drawing, given))
            except LimitError as error:
                self._ways[key] = error
        made = self._ways[key]
        if isinstance(made, LimitError):
            raise made
        return made

    def _with_source(self, conversion: Made) -> Made:
        """Add the source's name to a packed texture, so that its file is as large as that of `vexture convert`."""
        from vexture.texture.texture import Texture

        if not isinstance(conversion.texture, Texture):
            return conversion
        return replace(conversion, texture=replace(conversion.texture, source=self.path.name))

    def _check_sampled(self) -> None:
        """Raise a `LimitError` if a conversion by the thesis's own method would take minutes."""
        quads = len(self.way("direct").tree.coverage)
        if quads > MOST_FOR_SAMPLED:
            raise LimitError(
                f"{self.name}: direct has {quads:,} quads, so sampled would take minutes; the limit of a report is "
                f"{MOST_FOR_SAMPLED:,}; give a simpler drawing"
            )
