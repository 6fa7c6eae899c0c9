// Made by tools/make_web.py; change packages/vexture/src/vexture/fold/layout.py and run it again.
export const ENCODING_FOLD = "fold";
export const FOLD_FILE_LIMIT = 4194304;
export const FOLD_KIND_SHIFT = 29;
export const FOLD_LINEAR = 0;
export const FOLD_MOST_DISPLACEMENT = 1.0;
export const FOLD_MOST_SECONDS = 8191;
export const FOLD_MOST_SIDE = 256;
export const FOLD_PERIODIC = 4;
export const FOLD_SMOOTH_BOTH = 3;
export const FOLD_SMOOTH_END = 2;
export const FOLD_SMOOTH_START = 1;
export const FOLD_SUFFIX = ".fold.ktx2";
export const FOLD_TICKS = 65536;
export const FOLD_VERSION = "1";
export const TEXT_FOLD = "vexture.fold";
