// Reads files from standard input, each after its length, with a loader of web/src, and answers each with a line of
// JSON: what it holds, why it was refused, or the fault of the loader.
import { readSync, writeSync } from 'node:fs';
import { FoldTexture, VectorTexture, VextureError, bounds, counts, readPacked } from '../../web/src/index.js';
import { ThesisTexture, readThesis } from '../../web/src/thesis/index.js';

const PNG = Buffer.from('89504e470d0a1a0a', 'hex');
const PLACES = Array.from({ length: 16 }, (_, i) => [(i % 4) / 4 + 0.103, Math.floor(i / 4) / 4 + 0.157]);

const LOADERS = {
  /** @param {Buffer} file */
  async packed(file) {
    const data = await readPacked(file, 'file');
    const { quad } = data.roots[0];
    bounds(data, quad);
    const texture = new VectorTexture(data);
    const colors = PLACES.map(([u, v]) => texture.colorAt(u, v, 0));
    if (!colors.every(({ color, opacity }) => [...color, opacity].every((part) => part >= 0 && part <= 1))) {
      throw new Error(`a colour is out of range: ${JSON.stringify(colors)}`);
    }
    return { count: counts(data, quad), inside: PLACES.map(([u, v]) => texture.contains(u, v, 0)) };
  },
  /** @param {Buffer} file */
  async fold(file) {
    const fold = await FoldTexture.parse(file, 'file');
    const at = PLACES.map(([u, v]) => fold.at(u, v, 8 * u + v));
    if (!at.every(({ u, v }) => Number.isFinite(u + v))) throw new Error(`a fold is not finite: ${JSON.stringify(at)}`);
    return fold.size;
  },
  /** @param {Buffer} file both files, one after the other */
  async thesis(file) {
    const second = Math.max(file.lastIndexOf(PNG), 0);
    const texture = new ThesisTexture(await readThesis(file.subarray(0, second), file.subarray(second), 'file'));
    return { inside: PLACES.map(([u, v]) => texture.contains(u, v)) };
  },
};

/** @param {number} length */
function read(length) {
  const bytes = Buffer.alloc(length);
  for (let at = 0; at < length; ) {
    const got = readSync(0, bytes, at, length - at, null);
    if (!got) process.exit(0);
    at += got;
  }
  return bytes;
}

/** @param {unknown} error */
function fault(error) {
  return { fault: error instanceof Error ? error.stack : String(error) };
}

/** @param {object} value */
function answer(value) {
  writeSync(1, `${JSON.stringify(value)}\n`);
}

process.on('uncaughtException', (error) => {
  answer(fault(error));
  process.exit(1);
});

const load = LOADERS[process.argv[2]];
for (;;) {
  const file = read(read(4).readUInt32LE());
  answer(await load(file).catch((error) => (error instanceof VextureError ? { error: error.message } : fault(error))));
}
