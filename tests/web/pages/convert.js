// Converts for tests: the package as a page with a bundler has it, with the worker and the kernels at their addresses.
import { Converter, convert, convertData, fromContours, readGeojson, readSvg, writePacked } from '../../../web/src/convert/index.js';
import { VectorTexture } from '../../../web/src/index.js';

/** A result for the test: what it is, or its one error. */
async function outcome(converting) {
  const start = performance.now();
  try {
    const texture = await converting;
    return {
      isTexture: texture instanceof VectorTexture,
      roots: texture.roots.map(({ name, isMap }) => ({ name, isMap })),
      colors: texture.roots.map(({ paint }) => paint?.color ?? null),
      notes: texture.notes,
      ms: performance.now() - start,
    };
  } catch (error) {
    return { error: `${error?.name}: ${error?.message ?? error}`, field: error?.field, ms: performance.now() - start };
  }
}

/** The outcome, and how often the page answered a timer meanwhile. */
async function watched(converting) {
  let ticks = 0;
  const timer = setInterval(() => ticks++, 5);
  const found = await outcome(converting);
  clearInterval(timer);
  return { ...found, ticks };
}

/** Content of a file in base64. */
async function fileOf(source, options) {
  const bytes = await writePacked(await convertData(source, options));
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}

/** Overlapping coloured shapes, which take long to convert. */
function heavy(count = 400) {
  const shapes = Array.from({ length: count }, (_, k) => {
    const points = Array.from({ length: 24 }, (_, j) => `${50 + 45 * Math.sin(k + 7.1 * j * (1 + k / count))},${50 + 45 * Math.cos(2 * k + 5.3 * j)}`);
    return `<path fill="hsl(${(137 * k) % 360} 60% 50%)" d="M${points.join('L')}Z"/>`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">${shapes.join('')}</svg>`;
}

Object.assign(window, { Converter, convert, convertData, fileOf, fromContours, heavy, outcome, readGeojson, readSvg, watched, writePacked });
