import { describe, expect, test } from 'vitest';
import { deflateSync } from 'node:zlib';
import { TEXT_ENCODING, TEXT_VERSION } from '../generated/layout.js';
import { TEXT_CRS, TEXT_TRANSFORM } from '../generated/thesis-layout.js';
import { readThesis } from '../src/thesis/index.js';
import { readPng } from '../src/thesis/png.js';
import { chunksOf, fixture, png, rechunked, repainted } from './files.js';
import { expectRefusal } from './refused.js';

const sixteen = [fixture('sixteen/duck.quads.png'), fixture('sixteen/duck.curves.png')];
const eight = [fixture('eight/simple-small.quads.png'), fixture('eight/simple-small.curves.png')];

/** @typedef {{ tag: string, body: Uint8Array }} Chunk */

const text = (/** @type {string} */ key, /** @type {string} */ value) => ({ tag: 'tEXt', body: Buffer.from(`${key}\0${value}`, 'latin1') });

/** Both files of a pair with a text changed. */
const retexted = (/** @type {string} */ key, /** @type {Chunk | null} */ chunk) =>
  sixteen.map((file) =>
    rechunked(file, ([header, ...others]) => {
      const kept = others.filter(({ body }) => !Buffer.from(body).toString('latin1').startsWith(`${key}\0`));
      return [header, ...(chunk ? [chunk] : []), ...kept];
    }),
  );

/** A pair with channels changed, of the quads or of the curves. */
async function altered(/** @type {Uint8Array[]} */ [quads, curves], /** @type {(pixels: any) => void} */ change, ofCurves = false) {
  const [file, width] = ofCurves ? [curves, 2] : [quads, 4];
  const { pixels } = await readPng(file, width);
  const other = repainted(file, pixels, width, change);
  return ofCurves ? [quads, other] : [other, curves];
}

describe('what is read', () => {
  test('the example of FORMAT.md, A.7', async () => {
    const [quads, curves] = [
      [0, 255, 128, 0, 85, 128, 0, 0, 128, 0, 170, 128],
      [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 115, 140, 128, 140, 115, 0, 115, 140, 128, 140, 115],
    ].map((pixels) => Uint8Array.from(pixels));
    const small = await Promise.all(eight.map((file, place) => readPng(file, 4 - 2 * place)));
    const header = (/** @type {number} */ rows) => (/** @type {Chunk[]} */ chunks) => {
      chunks[0].body[7] = rows;
    };
    const files = [
      rechunked(repainted(eight[0], quads, 4, () => {}), header(1)),
      rechunked(repainted(eight[1], curves, 2, () => {}), header(4)),
    ];
    const data = await readThesis(files[0], files[1], 'triangle');
    expect(data).toMatchObject({ encoding: 'thesis', bits: 8, quadCount: 1, curveCount: 4, levels: 1, quads, curves });
    expect(small[0].bits).toBe(8);
  });

  test('pairs of the converter, with all their bits', async () => {
    const data = await readThesis(sixteen[0], sixteen[1].buffer, 'duck');
    expect(data).toMatchObject({ bits: 16, quadCount: 16, curveCount: 40, levels: 5 });
    expect(new Set(Array.from(data.curves, (channel) => channel & 255)).size).toBeGreaterThan(50);
    expect(data.roots[0]).toMatchObject({ name: 'duck', quad: 0, crs: null });
    expect((await readThesis(eight[0], eight[1])).bits).toBe(8);
  });

  test('a coordinate reference system, in Latin-1 and in UTF-8', async () => {
    const international = Buffer.concat([Buffer.from(`${TEXT_CRS}\0\0\0\0\0`), Buffer.from('Амерсфорт')]);
    for (const [chunk, crs] of /** @type {[Chunk, string][]} */ ([
      [text(TEXT_CRS, 'EPSG:28992'), 'EPSG:28992'],
      [{ tag: 'iTXt', body: international }, 'Амерсфорт'],
    ])) {
      const [quads, curves] = retexted(TEXT_CRS, chunk);
      expect((await readThesis(quads, curves)).roots[0].crs).toBe(crs);
    }
  });

  test('profiles and other chunks are not looked at', async () => {
    const bomb = { tag: 'iCCP', body: Buffer.concat([Buffer.from('profile\0\0'), deflateSync(Buffer.alloc(1 << 26))]) };
    const files = sixteen.map((file) => rechunked(file, ([header, ...others]) => [header, bomb, ...others]));
    expect((await readThesis(files[0], files[1])).quadCount).toBe(16);
  });
});

describe('the files', () => {
  test('cut off at any byte', async () => {
    for (let length = 0; length < sixteen[0].length; length++) {
      await expectRefusal(readThesis(sixteen[0].subarray(0, length), sixteen[1], 'duck'), /./, /^duck: quads: /);
    }
  });

  test('any byte changed is refused or harmless', async () => {
    const whole = await readThesis(eight[0], eight[1], 'small');
    for (let at = 0; at < eight[1].length; at++) {
      const copy = eight[1].slice();
      copy[at] ^= 0x21;
      await readThesis(eight[0], copy, 'small').then(
        (data) => expect(data.curves).toEqual(whole.curves),
        (error) => expect(error).toMatchObject({ name: 'VextureError', message: expect.stringMatching(/^small: [^\n]+$/) }),
      );
    }
  });

  /** @type {[string, number, number, string][]} */
  const headers = [
    ['width', 3, 5, 'width'],
    ['height of nothing', 7, 0, 'height'],
    ['height beyond the longest list', 5, 1, 'height'],
    ['palette', 9, 3, 'colour type'],
    ['alpha', 9, 6, 'colour type'],
    ['4 bits', 8, 4, 'bit depth'],
    ['interlaced', 12, 1, 'interlace'],
  ];
  test.each(headers)('%s', async (_, at, value, field) => {
    const quads = rechunked(sixteen[0], (chunks) => {
      chunks[0].body[at] = value;
    });
    await expectRefusal(readThesis(quads, sixteen[1]), field);
  });

  test('no header, or two', async () => {
    const [header, ...others] = chunksOf(sixteen[0]);
    for (const chunks of [others, [header, header, ...others]]) {
      await expectRefusal(readThesis(png(chunks), sixteen[1]), 'IHDR');
    }
  });

  test('images of more or fewer bytes than their pixels', async () => {
    for (const bytes of [1 << 24, 10]) {
      const quads = rechunked(sixteen[0], (chunks) => {
        chunks.splice(-2, 1, { tag: 'IDAT', body: deflateSync(Buffer.alloc(bytes)) });
      });
      await expectRefusal(readThesis(quads, sixteen[1]), 'IDAT');
    }
  });

  test('other files', async () => {
    await expectRefusal(readThesis(Buffer.from('no picture'), sixteen[1]), 'signature', /a thesis texture is a pair of PNGs/);
    await expectRefusal(readThesis(sixteen[0], new Uint8Array(3_200_000)), 'byteLength', /curves: longer than/);
    await expectRefusal(readThesis(sixteen[1], sixteen[0]), 'width');
  });

  test('two that do not belong together', async () => {
    await expectRefusal(readThesis(sixteen[0], eight[1]), 'bit depth', /quads of 16 bits with curves of 8/);
    const [other] = retexted(TEXT_TRANSFORM, text(TEXT_TRANSFORM, '2 0 0 0 2 0'));
    await expectRefusal(readThesis(other, sixteen[1]), TEXT_TRANSFORM, /differs/);
  });

  test.each([
    [TEXT_VERSION, '2'],
    [TEXT_ENCODING, 'packed'],
    [TEXT_TRANSFORM, '1 0 0 0 1'],
    [TEXT_TRANSFORM, '1 0 0 0 1 nan'],
    [TEXT_TRANSFORM, '1 0 0 0 1 1e999'],
    [TEXT_TRANSFORM, '1 0 0 0 1 0x10'],
  ])('%s %s', async (key, value) => {
    for (const chunk of [text(key, value), null]) {
      const [quads, curves] = retexted(key, chunk);
      await expectRefusal(readThesis(quads, curves), key);
    }
  });
});

describe('the tree', () => {
  test('references that are out of order, backwards or missing', async () => {
    const { pixels } = await readPng(sixteen[0], 4);
    let refused = 0;
    for (let at = 0; at < pixels.length; at++) {
      if (at % 3 === 2) continue;
      for (const value of [0, 65535, 32768, 30000]) {
        const [quads, curves] = await altered(sixteen, (p) => void (p[at] = value));
        await readThesis(quads, curves).catch((error) => {
          expect(error).toMatchObject({ name: 'VextureError', field: expect.stringMatching(/^(quad|curve) \d+$/) });
          refused++;
        });
      }
    }
    expect(refused).toBeGreaterThan(300);
  });

  test('coverages of a quad that differ', async () => {
    const [quads, curves] = await altered(sixteen, (p) => void p[12 * 3 + 5]++);
    await expectRefusal(readThesis(quads, curves), 'quad 3', /has coverages/);
  });

  test('a curve that ends where it starts', async () => {
    const [quads, curves] = await altered(sixteen, (p) => void (p[6 * 4 + 3] = p[6 * 4]), true);
    await expectRefusal(readThesis(quads, curves), 'curve 4', /both at edge step/);
  });

  test('too few rows of curves', async () => {
    const one = rechunked(repainted(eight[1], new Uint8Array(6), 2, () => {}), (chunks) => {
      chunks[0].body[7] = 1;
    });
    await expectRefusal(readThesis(eight[0], one), 'height', /at least 2/);
  });
});
