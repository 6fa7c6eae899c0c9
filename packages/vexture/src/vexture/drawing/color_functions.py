"""CSS colour functions beyond sRGB: other colour spaces, mixtures, and relative colours (CSS Color 4 and 5)."""

from math import isnan
from typing import Any, Final, NamedTuple

import tinycss2
from coloraide import Color

from vexture.drawing.calculation import keyword, reduce_calculations, split_arguments

Rgba = tuple[float, float, float, float]
"""Red, green, blue and opacity in sRGB; the channels may lie outside 0..1."""


class ColorModel(NamedTuple):
    """A colour function of three channels."""

    space: str
    channels: str
    scales: tuple[float, float, float] = (1.0, 1.0, 1.0)  # factors from the space's units to the function's


MODELS: Final = {
    "rgb": ColorModel("srgb", "rgb", (255.0, 255.0, 255.0)),
    "rgba": ColorModel("srgb", "rgb", (255.0, 255.0, 255.0)),
    "hsl": ColorModel("hsl", "hsl", (1.0, 100.0, 100.0)),
    "hsla": ColorModel("hsl", "hsl", (1.0, 100.0, 100.0)),
    "hwb": ColorModel("hwb", "hwb", (1.0, 100.0, 100.0)),
    "lab": ColorModel("lab", "lab"),
    "lch": ColorModel("lch", "lch"),
    "oklab": ColorModel("oklab", "lab"),
    "oklch": ColorModel("oklch", "lch"),
}

RGB_SPACES: Final = frozenset(
    {"srgb", "srgb-linear", "display-p3", "display-p3-linear", "a98-rgb", "prophoto-rgb", "rec2020"}
)
XYZ_SPACES: Final = {"xyz": "xyz-d65", "xyz-d50": "xyz-d50", "xyz-d65": "xyz-d65"}

MIXED_IN: Final = (
    {name: name for name in RGB_SPACES} | XYZ_SPACES | {model.space: model.space for model in MODELS.values()}
)
"""Colour spaces of `color-mix()`, by name."""

HUES: Final = frozenset({"shorter", "longer", "increasing", "decreasing"})

DEFAULT_SPACE: Final = "oklab"


class InvalidColorError(Exception):
    """The colour is not valid."""


def color_of_function(token: Any, current: Rgba | None) -> Rgba | None:
    """Return the colour of a function, with `current` as `currentcolor`; None if it is not valid.

    Examples
    --------
    >>> mixture = tinycss2.parse_one_component_value("color-mix(in srgb, red 25%, rgb(from #800 0 g calc(r * 2 - 17)))")
    >>> [round(part, 3) for part in color_of_function(mixture, None)]
    [0.25, 0.0, 0.75, 1.0]
    """
    try:
        found = wide(token, current).convert("srgb")
        red, green, blue = found.coords(nans=False)
        return red, green, blue, min(max(found.alpha(nans=False), 0.0), 1.0)
    except (InvalidColorError, ValueError, OverflowError):
        return None


def wide(token: Any, current: Rgba | None) -> Color:
    """Return the colour of a token in its own colour space."""
    if token.type == "ident" and token.lower_value == "currentcolor" and current is not None:
        return Color("srgb", current[:3], current[3])
    if token.type != "function":
        return plain(tinycss2.serialize([token]))
    arguments = [part for part in token.arguments if part.type != "whitespace"]
    if token.lower_name == "light-dark":
        light, _ = (wide(single(part), current) for part in pair(token))
        return light
    if token.lower_name == "color-mix":
        return mixture(token, current)
    if arguments and keyword(arguments[:1]) == "from":
        return relative(token.lower_name, arguments[1:], current)
    if token.lower_name == "color" and keyword(arguments[:1]) not in {*RGB_SPACES, *XYZ_SPACES}:
        raise InvalidColorError
    if token.lower_name != "color" and token.lower_name not in MODELS:
        raise InvalidColorError
    return plain(reduce_calculations(tinycss2.serialize([token])))


def plain(text: str) -> Color:
    """Parse a colour that contains neither calculations nor other colours."""
    found = Color(text)
    if found.space() in ("lab", "lch", "oklab", "oklch"):  # clamped as browsers do (CSS Color 4, 9.3)
        whole = 1.0 if found.space().startswith("ok") else 100.0
        found[0] = min(max(found[0], 0.0), whole) if not isnan(found[0]) else found[0]
        if found.space().endswith("ch") and found[1] < 0.0:
            found[1] = 0.0
    return found


def pair(token: Any) -> list[list[Any]]:
    """Return the two arguments of a function."""
    parts = split_arguments(token.arguments)
    if len(parts) != 2:
        raise InvalidColorError
    return parts


def single(tokens: list[Any]) -> Any:
    """Return the only token that is not whitespace."""
    found = [token for token in tokens if token.type != "whitespace"]
    if len(found) != 1:
        raise InvalidColorError
    return found[0]


def mixture(token: Any, current: Rgba | None) -> Color:
    """Return the colour of `color-mix()` (CSS Color 5, 2)."""
    parts = split_arguments(token.arguments)
    words = [str(part.lower_value) if part.type == "ident" else "" for part in parts[0] if part.type != "whitespace"]
    space, hue = DEFAULT_SPACE, "shorter"
    if words and words[0] == "in":
        parts = parts[1:]
        if len(words) not in (2, 4) or words[1] not in MIXED_IN:
            raise InvalidColorError
        space = MIXED_IN[words[1]]
        if len(words) == 4:
            hue = words[2]
            if hue not in HUES or words[3] != "hue":
                raise InvalidColorError
    if len(parts) != 2:
        raise InvalidColorError
    (first, part), (second, other) = (weighted_color(each, current) for each in parts)
    if part is None:
        part = 1.0 - other if other is not None else 0.5
    if other is None:
        other = 1.0 - part
    whole = part + other
    if whole == 0.0:
        return Color("srgb", (0.0, 0.0, 0.0), 0.0)
    found = first.mix(
        second,
        other / whole,
        space=space,
        out_space=space,
        hue=hue,
        premultiplied=True,
        carryforward=True,
        powerless=True,
    )
    found["alpha"] = found.alpha(nans=False) * min(whole, 1.0)
    return found


def weighted_color(tokens: list[Any], current: Rgba | None) -> tuple[Color, float | None]:
    """Return a colour of a mixture with its share, or None if no share is given."""
    weights = [tinycss2.parse_one_component_value(reduce_calculations(tinycss2.serialize([token]))) for token in tokens]
    found = [weight.value / 100.0 for weight in weights if weight.type == "percentage"]
    others = [token for token, weight in zip(tokens, weights, strict=True) if weight.type != "percentage"]
    if len(found) > 1 or not all(0.0 <= weight <= 1.0 for weight in found):
        raise InvalidColorError
    return wide(single(others), current), found[0] if found else None


def relative(name: str, arguments: list[Any], current: Rgba | None) -> Color:
    """Return a relative colour, which is made from the channels of another colour (CSS Color 5, 4)."""
    if not arguments:
        raise InvalidColorError
    origin, prefix = wide(arguments[0], current), ""
    model, rest = MODELS.get(name), arguments[1:]
    if name == "color" and rest:
        space = keyword(rest[:1])
        if space not in MIXED_IN or space in MODELS:
            raise InvalidColorError
        model, rest, prefix = (
            ColorModel(MIXED_IN[space], "xyz" if space in XYZ_SPACES else "rgb"),
            rest[1:],
            f"{space} ",
        )
    if model is None:
        raise InvalidColorError
    origin = origin.convert(model.space)
    values = zip(model.channels, origin.coords(nans=False), model.scales, strict=True)
    channels = {channel: value * scale for channel, value, scale in values}
    channels["alpha"] = origin.alpha(nans=False)
    slash = next((at for at, token in enumerate(rest) if token == "/"), None)
    alpha = channels["alpha"] if slash is None else None
    written = " ".join(reduce_calculations(fill_channels(token, channels)) for token in rest)
    return plain(f"{name}({prefix}{written}{f' / {alpha!r}' if alpha is not None else ''})")


def fill_channels(token: Any, channels: dict[str, float]) -> str:
    """Serialize a token, with numbers in place of the names of channels."""
    if token.type == "ident" and token.lower_value in channels:
        return f"{channels[token.lower_value]:.12f}"
    if token.type == "function":
        return f"{token.name}({''.join(fill_channels(part, channels) for part in token.arguments)})"
    if token.type == "() block":
        return f"({''.join(fill_channels(part, channels) for part in token.content)})"
    return str(tinycss2.serialize([token]))
