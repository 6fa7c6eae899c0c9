// Some tests need the kernels in WebAssembly, which `make test` compiles beside the tests that need none. It runs those
// that need them afterwards: see tests/web/test_kernels.py.
import { existsSync } from 'node:fs';
import { describe } from 'vitest';

const MODULES = ['silhouettes', 'maps', 'strokes'];

const missing = MODULES.filter((name) => !existsSync(new URL(`../kernels/${name}.wasm`, import.meta.url)));
if (missing.length > 0) console.warn(`no ${missing.join(', ')} in web/kernels/ (make wasm): tests that need them are skipped`);

/** `describe` for tests that need the kernels: they are skipped where a module is not built. */
export const describeWithKernels = describe.skipIf(missing.length > 0);
