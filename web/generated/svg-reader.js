// Made by tools/make_web.py; change packages/vexture/src/vexture/svg/ and run it again.
export const ANIMATIONS = ["animate", "animateColor", "animateMotion", "animateTransform", "discard", "set"];
export const BLENDS = ["normal", "multiply", "screen", "overlay", "darken", "lighten", "color-dodge", "color-burn", "hard-light", "soft-light", "difference", "exclusion", "hue", "saturation", "color", "luminosity", "plus-lighter"];
export const CLOSED = 1e-09;
export const CONTAINERS = ["a", "g", "svg", "switch", "symbol"];
export const DEEPEST = 1000;
export const FARTHEST = 1000000000.0;
export const FILTER_STEPS = ["feBlend", "feColorMatrix", "feComponentTransfer", "feComposite", "feConvolveMatrix", "feDiffuseLighting", "feDisplacementMap", "feDropShadow", "feFlood", "feGaussianBlur", "feImage", "feMerge", "feMorphology", "feOffset", "feSpecularLighting", "feTile", "feTurbulence"];
export const LANGUAGE = "en";
export const LARGEST = 1000000000000.0;
export const MOST_ATTRIBUTES = 1000;
export const MOST_DASHES = 100000;
export const MOST_MASKS = 32;
export const MOST_FILE_PIXELS = 50000000;
export const MOST_PICTURE_PIXELS = 100000000;
export const MOST_PICTURE_TEXELS = 262144;
export const MOST_SEGMENTS = 5000000;
export const MOST_STOPS = 128;
/** @type {Readonly<Record<string, number>>} */
export const MOST_TILED = {"elements": 20000, "segments": 400000, "gradients": 2000};
export const MOST_USED = 50000;
export const PIXELATED = ["-moz-crisp-edges", "crisp-edges", "optimizespeed", "pixelated"];
/** @type {Readonly<Record<string, number>>} */
export const PIXELS = {"": 1.0, "px": 1.0, "pt": 1.3333333333333333, "pc": 16.0, "in": 96.0, "cm": 37.79527559055118, "mm": 3.7795275590551185, "q": 0.9448818897637796};
export const ROUND = 1e-05;
/** @type {Readonly<Record<string, string>>} */
export const UNKNOWN_SERVERS = {"meshgradient": "gradient mesh", "meshGradient": "gradient mesh", "hatch": "hatch"};
export const UNPAINTED = ["animate", "animateColor", "animateMotion", "animateTransform", "clipPath", "color-profile", "cursor", "defs", "desc", "discard", "filter", "font", "font-face", "hatch", "linearGradient", "marker", "mask", "meshgradient", "metadata", "pattern", "radialGradient", "script", "set", "solidcolor", "style", "title", "view"];
