// Made by tools/make_web.py; change packages/vexture/src/vexture/renderers/method.py and run it again.
/** Values of VEXTURE_WRAP. */
export const WRAPS = Object.freeze({"none": 0, "clamp": 1, "repeat": 2});
