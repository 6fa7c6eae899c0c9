// What Vite must be told, so that the workers of `vexture/text` and `vexture/convert` run in development and from a build.

/** What the worker of texts imports that is CommonJS or imports some; Vite converts it only if it is named. */
const IN_WORKERS = Object.freeze(['linebreak', 'brotli/decompress']);

/** And what pages import, where this package is not converted as a whole. */
const IN_PAGES = Object.freeze(['saxes']);

/** The first Vite whose converted packages find their workers. */
const FINDS_WORKERS = 8;

/**
 * @param {import('vite').UserConfig} user what the project's configuration says
 * @param {string} [version] of Vite
 * @returns {import('vite').UserConfig}
 */
export function configOfWorkers({ worker }, version = '6') {
  const ours = (/** @type {readonly string[]} */ names) => names.map((name) => `vexture > ${name}`);
  const format = worker?.format ?? 'es'; // HarfBuzz has a top-level await, which only modules can have
  if (Number.parseInt(version, 10) >= FINDS_WORKERS) return { worker: { format }, optimizeDeps: { include: ours(IN_WORKERS) } };
  const include = ['three', ...ours([...IN_WORKERS, ...IN_PAGES])]; // the same three.js as that of other packages
  return { worker: { format }, optimizeDeps: { exclude: ['vexture'], include } };
}
