"""Appearance of a drawing on a material: the members of the material's extension (FORMAT.md, E.3)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias, get_args

from vexture.base.errors import ParameterError

if TYPE_CHECKING:
    from vexture.conversion.parameters import Split
    from vexture.texture.texture import Texture

Mode: TypeAlias = Literal["paint", "mix", "cut", "alpha"]
Wrap: TypeAlias = Literal["none", "clamp", "repeat"]
Background: TypeAlias = Literal["own", "none"]

MODES: Final = get_args(Mode)
WRAPS: Final = get_args(Wrap)

CHOICES: Final[dict[str, tuple[Any, ...]]] = {
    "mode": MODES,
    "wrap": WRAPS,
    "background": get_args(Background),
    "tex_coord": (0, 1),
    "invert": (False, True),
}

FOR_MODES: Final = {"color": ("mix",), "threshold": ("cut",), "background": ("paint",), "invert": MODES[1:]}
"""Modes in which a parameter has a meaning."""

WHITE: Final = (1.0, 1.0, 1.0)
HALF: Final = 0.5
"""Default colour and threshold of a mask."""

DIGITS: Final = 6
"""Decimals of a colour."""


@dataclass(frozen=True, slots=True)
class Appearance:
    """Appearance of a drawing on a material; `Model.with_drawing` describes the parameters.

    Examples
    --------
    >>> Appearance("cut", threshold=0.25, scale=(2, 2)).facts()
    {'mode': 'cut', 'threshold': 0.25, 'transform': {'scale': [2.0, 2.0]}}
    >>> Appearance("glow")
    Traceback (most recent call last):
    vexture.base.errors.ParameterError: `mode` is 'glow'; it must be one of 'paint', 'mix', 'cut', 'alpha'
    """

    mode: Mode = "paint"
    root: str | int | None = None
    wrap: Wrap = "none"
    invert: bool = False
    background: Background = "own"
    color: str | Sequence[float] = WHITE
    threshold: float = HALF
    tex_coord: int = 0
    offset: tuple[float, float] = (0.0, 0.0)
    rotation: float = 0.0
    scale: tuple[float, float] = (1.0, 1.0)

    def __post_init__(self) -> None:
        for name, allowed in CHOICES.items():
            value = getattr(self, name)
            if value not in allowed:
                raise ParameterError(f"`{name}` is {value!r:.80}; it must be one of {', '.join(map(repr, allowed))}")
        for field in fields(self):
            modes = FOR_MODES.get(field.name, MODES)
            if self.mode not in modes and getattr(self, field.name) != field.default:
                raise ParameterError(f"`{field.name}` is for the mode {' or '.join(modes)}; leave it out")
        if not (isinstance(self.threshold, int | float) and 0.0 <= self.threshold <= 1.0):
            raise ParameterError(f"`threshold` is {self.threshold!r:.80}; it must be a coverage, 0 to 1")
        self._linear_color()
        self._transform()

    def facts(self) -> dict[str, Any]:
        """Return the members of the extension that differ from their defaults, without the texture."""
        values: dict[str, Any] = {"root": self.root, "mode": self.mode, "wrap": self.wrap, "invert": self.invert}
        values |= {"background": self.background, "color": self._linear_color(), "threshold": float(self.threshold)}
        values |= {"texCoord": self.tex_coord, "transform": self._transform()}
        without: dict[str, Any] = {"root": None, "wrap": "none", "invert": False, "background": "own"}
        without |= {"color": [*WHITE], "threshold": HALF, "texCoord": 0, "transform": {}}
        return {name: value for name, value in values.items() if name not in without or value != without[name]}

    @property
    def split(self) -> "Split":
        """Split for the conversion of the drawing: in its colours, or as its silhouette."""
        return "faces" if self.mode == "paint" else None

    def check(self, texture: "Texture") -> None:
        """Raise a `ParameterError` if the texture lacks the root, or has several and none is chosen."""
        from vexture.texture.select_root import layers_of, place_of

        if self.mode == "paint":
            layers_of(texture.roots, self.root, texture.name)
        else:
            place_of(texture.roots, self.root, texture.name)

    def _linear_color(self) -> list[float]:
        from coloraide import Color as AnyColor

        from vexture.drawing.colors import Color, parse_color

        rgb: Sequence[float] = ()
        if isinstance(self.color, str):
            parsed = parse_color(self.color)
            rgb = parsed.rgb if isinstance(parsed, Color) and parsed.alpha == 1.0 else ()
        elif all(isinstance(part, int | float) for part in self.color):
            rgb = self.color
        if len(rgb) != 3 or not all(0.0 <= part <= 1.0 for part in rgb):
            raise ParameterError(f"`color` is {self.color!r:.80}; give an opaque CSS colour, or three numbers, 0 to 1")
        return [round(part, DIGITS) for part in AnyColor("srgb", rgb).convert("srgb-linear").coords()]

    def _transform(self) -> dict[str, Any]:
        """Return the members of KHR_texture_transform that differ from their defaults."""
        numbers = {"offset": self.offset, "scale": self.scale, "rotation": (self.rotation,)}
        for name, pair in numbers.items():
            length = 1 if name == "rotation" else 2
            good = isinstance(pair, Sequence) and all(isinstance(one, int | float) for one in pair)
            if not good or len(pair) != length or not all(map(math.isfinite, pair)):
                what = "a finite number" if length == 1 else "two finite numbers"
                raise ParameterError(f"`{name}` is {getattr(self, name)!r:.80}; it must be {what}")
        if 0 in self.scale:
            raise ParameterError(f"`scale` is {self.scale!r:.80}; by 0 the drawing is a line; give other numbers")
        turned = -math.radians(self.rotation)
        values = {"offset": [*map(float, self.offset)], "rotation": turned, "scale": [*map(float, self.scale)]}
        without = {"offset": [0.0, 0.0], "rotation": 0.0, "scale": [1.0, 1.0]}
        return {name: value for name, value in values.items() if value != without[name]}
