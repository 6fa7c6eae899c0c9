import { describe, expect, test } from 'vitest';
import { MOST_STYLE_BYTES, TEXT_ENCODING, TEXT_ROOTS, TEXT_STYLES, TEXT_VERSION } from '../generated/layout.js';
import { readPacked } from '../src/packed.js';
import { FIELDS, TEXTS, altered, deflateSync, fixture, ktx2, patched } from './files.js';
import { expectRefusal } from './refused.js';

const duck = fixture('duck.ktx2');
const drawings = fixture('drawings.ktx2');

/** Texel of a quad whose four cells are full. */
const FULL = [0, 0, 0, 0xffffffff];

/** Word 2 of a quad whose first cell is a quad, the others constant. */
const ONE_QUAD = 0x80;

describe('what is read', () => {
  test('the example of FORMAT.md, B.10', async () => {
    const words = `00000001 00000001 0014140c 0048488f 80002000 a0006000 80006000 20002000 20006000 80008000 a0006000
      80000000 20000000 60006000 60008000 20006000 00008000 6000a000 80008000 60002000 60002000 80006000 60006000
      00002000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000`;
    const texels = Uint32Array.from(words.split(/\s+/), (word) => parseInt(word, 16));
    const data = await readPacked(ktx2(texels), 'triangle');
    expect(data).toMatchObject({ encoding: 'packed', name: 'triangle', width: 8, height: 1, texels });
    expect(data.roots).toEqual([
      { name: 'one', quad: 0, transform: [1, 0, 0, 0, 1, 0], tolerance: 0, crs: null, paint: null, isMap: false, hasGradients: false, hasPictures: false, style: null },
    ]);
  });

  test('files of the converter', async () => {
    const one = await readPacked(duck, 'file');
    expect(one).toMatchObject({ name: 'duck', width: 64, height: 1 });
    expect(one.roots.map(({ name }) => name)).toEqual(['duck']);
    const many = await readPacked(drawings.buffer, 'file');
    expect(many.roots.map(({ name }) => name.split('-')[0])).toEqual([
      'badge/1',
      'badge/2',
      'badge/3',
      'flag/1',
      'flag/2',
      'flag/3',
    ]);
    expect(many.roots[2].paint).toEqual({ color: [0xb9 / 255, 0x1c / 255, 0x1c / 255], opacity: 0.5 });
  });

  test('an image that is not deflated, at any place of its buffer', async () => {
    const plain = ktx2([FULL], TEXTS, { scheme: 0 });
    const moved = new Uint8Array(plain.length + 3);
    moved.set(plain, 3);
    expect((await readPacked(moved.subarray(3))).texels).toEqual(Uint32Array.from(FULL));
  });

  test('keys of others, values without a zero byte, levelCount 0', async () => {
    const file = ktx2([FULL], { ...TEXTS, 'a.stranger': Uint8Array.of(0xff, 0xfe) });
    expect((await readPacked(patched(file, FIELDS.levelCount, 0))).width).toBe(1);
  });

  test('several roots of one quad', async () => {
    const root = { name: 'same', quad: 0, transform: [1, 0, 0, 0, 1, 0] };
    const file = ktx2([FULL], { ...TEXTS, [TEXT_ROOTS]: JSON.stringify([root, root]) });
    expect((await readPacked(file)).roots).toHaveLength(2);
  });
});

describe('the container', () => {
  test.each(['vkFormat', 'typeSize', 'pixelDepth', 'layerCount', 'faceCount', 'levelCount', 'supercompressionScheme'])(
    '%s of another kind',
    async (field) => {
      const wrong = patched(duck, FIELDS[/** @type {keyof typeof FIELDS} */ (field)], 37);
      await expectRefusal(readPacked(wrong, 'wrong.ktx2'), field, `wrong.ktx2: ${field} is 37; it must be`);
    },
  );

  test('other files', async () => {
    await expectRefusal(readPacked(new Uint8Array(12)), 'identifier', /a packed texture is a KTX 2.0 file/);
    const svg = Buffer.from('<svg xmlns="http://www.w3.org/2000/svg">\n\n</svg>');
    await expectRefusal(readPacked(svg), 'identifier', 'is an SVG, not a texture; convert it first: vexture convert FILE');
  });

  test('cut off at any byte', async () => {
    for (let length = 0; length < duck.length; length++) {
      await expectRefusal(readPacked(duck.subarray(0, length)), /./);
    }
  });

  test.each([
    ['pixelWidth', 3],
    ['pixelWidth', 0],
    ['pixelWidth', 4096],
    ['pixelHeight', 0],
    ['pixelHeight', 2],
    ['sgdByteLength', 1],
    ['kvdByteLength', 0x1000001],
    ['uncompressedByteLength', 1040],
  ])('%s %i', async (field, value) => {
    const at = FIELDS[/** @type {keyof typeof FIELDS} */ (field)];
    await expectRefusal(readPacked(patched(duck, at, value)), field);
  });

  test.each([
    ['dfdByteOffset', 20],
    ['dfdByteOffset', duck.length],
    ['kvdByteOffset', 0xffffffff],
  ])('%s %i', async (field, value) => {
    const at = FIELDS[/** @type {keyof typeof FIELDS} */ (field)];
    await expectRefusal(readPacked(patched(duck, at, value)), field);
  });

  test('an image of more or fewer bytes than its texels', async () => {
    const many = deflateSync(Buffer.alloc(1 << 20));
    await expectRefusal(readPacked(ktx2([FULL], TEXTS, { image: many })), 'image', /inflates to more than 16 bytes/);
    await expectRefusal(readPacked(ktx2([FULL], TEXTS, { image: deflateSync(Buffer.alloc(15)) })), 'image', /to 15 bytes/);
    for (const bytes of [15, 17]) {
      const plain = ktx2([FULL], TEXTS, { scheme: 0, image: new Uint8Array(bytes) });
      await expectRefusal(readPacked(plain), 'byteLength');
    }
  });

  test('an image that is no zlib stream, or not whole', async () => {
    const whole = deflateSync(Buffer.from(Uint32Array.from(FULL).buffer));
    const cut = whole.subarray(0, -2); // in the checksum
    for (const image of [Buffer.from('no stream at all'), cut]) {
      await expectRefusal(readPacked(ktx2([FULL], TEXTS, { image })), 'image', /cannot be inflated/);
    }
  });

  test('memory is not taken for what a few bytes cannot become', async () => {
    const file = ktx2([FULL], TEXTS, { width: 2048, height: 16384, image: deflateSync(Buffer.alloc(16)) });
    await expectRefusal(readPacked(file), 'image', /cannot inflate to 536870912/);
  });

  test('every changed byte is refused or harmless', async () => {
    const whole = await readPacked(duck, 'duck');
    for (let at = 0; at < duck.length; at++) {
      const copy = duck.slice();
      copy[at] ^= 0x55;
      try {
        const data = await readPacked(copy, 'duck');
        expect([data.width, data.height]).toEqual([whole.width, whole.height]);
        expect(data.texels).toEqual(whole.texels); // the checksum of the stream sees to it
      } catch (error) {
        expect(error).toMatchObject({ name: 'VextureError', message: expect.stringMatching(/^duck: [^\n]+$/) });
      }
    }
  });
});

describe('the texts', () => {
  /** @type {[string, Record<string, string>, string][]} */
  const cases = [
    ['no version', { [TEXT_VERSION]: '' }, TEXT_VERSION],
    ['a later version', { [TEXT_VERSION]: '4' }, TEXT_VERSION],
    ['the version of pictures without any', { [TEXT_VERSION]: '3' }, TEXT_VERSION],
    ['the version of maps without any', { [TEXT_VERSION]: '2' }, TEXT_VERSION],
    ['a map in a file of version 1', { [TEXT_ROOTS]: TEXTS[TEXT_ROOTS].replace('}', ',"map":true}') }, TEXT_VERSION],
    ['another encoding', { [TEXT_ENCODING]: 'thesis' }, TEXT_ENCODING],
    ['roots that are no JSON', { [TEXT_ROOTS]: '[{"name":' }, TEXT_ROOTS],
    ['roots nested too deeply', { [TEXT_ROOTS]: '['.repeat(100000) }, TEXT_ROOTS],
    ['no roots', { [TEXT_ROOTS]: '[]' }, TEXT_ROOTS],
    ['roots that are no list', { [TEXT_ROOTS]: '{"0":1}' }, TEXT_ROOTS],
  ];
  test.each(cases)('%s', async (_, texts, field) => {
    await expectRefusal(readPacked(ktx2([FULL], { ...TEXTS, ...texts })), field);
  });

  test.each([
    ['', 7],
    ['.name', { name: 1 }],
    ['.quad', { quad: -1 }],
    ['.quad', { quad: 0.5 }],
    ['.quad', { quad: 2 ** 32 }],
    ['.quad', { quad: '0' }],
    ['.transform', { transform: [1, 0, 0, 0, 1] }],
    ['.transform', { transform: [1, 0, 0, 0, 1, null] }],
    ['.tolerance', { tolerance: -1 }],
    ['.crs', { crs: 28992 }],
    ['.map', { map: 1 }],
    ['.map', { map: null }],
    ['.paint', { paint: 'red' }],
    ['.paint', { paint: { color: [0, 0] } }],
    ['.paint', { paint: { color: [0, 0, 2] } }],
    ['.paint', { paint: { color: [0, 0, 0], opacity: -0.1 } }],
  ])('a root with a wrong %s', async (member, wrong) => {
    const right = { name: 'one', quad: 0, transform: [1, 0, 0, 0, 1, 0] };
    const entries = [right, typeof wrong === 'object' ? { ...right, ...wrong } : wrong];
    const file = ktx2([FULL], { ...TEXTS, [TEXT_ROOTS]: JSON.stringify(entries) });
    await expectRefusal(readPacked(file), `${TEXT_ROOTS}[1]${member}`);
  });

  test('numbers too large for a float', async () => {
    const text = '[{"name":"one","quad":0,"transform":[1e999,0,0,0,1,0]}]';
    await expectRefusal(readPacked(ktx2([FULL], { ...TEXTS, [TEXT_ROOTS]: text })), `${TEXT_ROOTS}[0].transform`);
  });

  test('damaged, or twice', async () => {
    const file = ktx2([FULL]);
    await expectRefusal(readPacked(patched(file, 104, 0)), 'keyAndValueByteLength');
    await expectRefusal(readPacked(patched(file, 104, 0xffff)), 'keyAndValueByteLength');
    await expectRefusal(readPacked(ktx2([FULL], { ...TEXTS, '': 'no key' })), 'keyAndValueByteLength');
    const twice = Buffer.from(ktx2([FULL], { 'vexture.one': '1', 'vexture.two': '2', ...TEXTS }));
    twice.write('vexture.one', twice.indexOf('vexture.two'));
    await expectRefusal(readPacked(twice), 'vexture.one', /twice/);
  });
});

describe('deflated styles', () => {
  const text = '[null]';
  const styles = (/** @type {number} */ length, /** @type {Uint8Array} */ stored) => {
    const value = Buffer.concat([Buffer.alloc(4), stored]);
    value.writeUInt32LE(length);
    return ktx2([FULL], { ...TEXTS, [TEXT_STYLES]: value });
  };

  test('are those of the roots', async () => {
    expect((await readPacked(styles(text.length, deflateSync(text)))).roots[0].style).toBe(null);
    expect((await readPacked(fixture('elements.ktx2'))).roots[0].style?.elements.length).toBeGreaterThan(5);
  });

  test.each([
    ['no bytes', 0, deflateSync('')],
    ['more than may be', MOST_STYLE_BYTES + 1, deflateSync(text)],
    ['fewer than they say', text.length + 1, deflateSync(text)],
    ['more than they say', text.length - 1, deflateSync(text)],
    ['no zlib stream', text.length, Buffer.from(text)],
    ['no JSON', 1, deflateSync('[')],
    ['none for a root', 2, deflateSync('[]')],
    ['no list', 2, deflateSync('{}')],
  ])('%s', async (_, length, stored) => {
    await expectRefusal(readPacked(styles(length, stored)), TEXT_STYLES);
  });

  test('of what is no map', async () => {
    await expectRefusal(readPacked(styles(4, deflateSync('[{}]'))), `${TEXT_ROOTS}[0].style`);
  });
});

describe('the tree', () => {
  test('a root out of the texels', async () => {
    const text = '[{"name":"one","quad":1,"transform":[1,0,0,0,1,0]}]';
    await expectRefusal(readPacked(ktx2([FULL], { ...TEXTS, [TEXT_ROOTS]: text })), 'quad 1', /of 1 texels/);
  });

  /** @type {[string, number[][], string][]} */
  const cases = [
    ['a quad out of the texels', [[1, 0, ONE_QUAD, 0]], 'quad 0'],
    ['quads that end out of the texels', [[1, 0, 0x8080, 0], FULL], 'quad 0'],
    ['curves out of the texels', [[0, 1, 0x0c, 0]], 'quad 0'],
    ['curves at the end of what 32 bits count', [[0, 0xffffffff, 0x7c, 0], FULL], 'quad 0'],
    ['a quad that is its own parent', [[0, 0, ONE_QUAD, 0]], 'quad 0'],
    ['a circle of two', [[1, 0, ONE_QUAD, 0], [0, 0, ONE_QUAD, 0]], 'quad 1'],
    ['a quad of two parents', [[1, 0, 0x8080, 0], [3, 0, ONE_QUAD, 0], [3, 0, ONE_QUAD, 0], FULL], 'texel 3'],
    ['a curve of two leaves', [[1, 2, 0x0c80, 0], [0, 2, 0x0c, 0], [0, 0, 0, 0], [0, 0, 0, 0]], 'texel 2'],
    ['a texel that is a quad and a curve', [[1, 1, 0x0c80, 0], FULL], 'texel 1'],
    ['what no root reaches', [FULL, [0, 0, 1, 0]], 'texel 1'],
    ['an end of a curve to the right of its leaf', [[0, 1, 0x0c, 0], [32769, 0, 0, 0]], 'curve 1'],
    ['an end of a curve above its leaf', [[0, 1, 0x0c, 0], [0, 0, 0, 32769 * 65536]], 'curve 1'],
  ];
  test.each(cases)('%s', async (_, texels, field) => {
    while (texels.length & (texels.length - 1)) texels.push([0, 0, 0, 0]);
    await expectRefusal(readPacked(ktx2(texels)), field);
  });

  test('ends at the border of a leaf are right', async () => {
    const texels = [[0, 1, 0x0c, 0], [32768, 0, 0, 32768 * 65536]];
    expect((await readPacked(ktx2(texels))).width).toBe(2);
  });

  test('every byte that says what a cell is', async () => {
    for (let byte = 0; byte < 256; byte++) {
      const count = byte < 128 ? byte >> 3 : byte === 128 ? 1 : 0;
      const named = byte === 0 || byte === 128 || (byte < 128 && byte >= 8 && (byte & 7) > 0);
      const texels = [[1, 1, byte * 2 ** 16, 0], ...Array.from({ length: 15 }, () => [0, 0, 0, 0])];
      if (count && byte === 128) texels[1] = FULL;
      if (named) expect((await readPacked(ktx2(texels))).width).toBe(16);
      else await expectRefusal(readPacked(ktx2(texels)), 'quad 0', `cell 2 is ${byte}, which is no valid cell`);
    }
  });

  test('as deep as the format allows, and one deeper', async () => {
    const chain = (/** @type {number} */ depth) =>
      Array.from({ length: 32 }, (_, quad) => (quad < depth ? [quad + 1, 0, ONE_QUAD, 0] : [0, 0, 0, 0]));
    expect((await readPacked(ktx2(chain(19)))).width).toBe(32);
    await expectRefusal(readPacked(ktx2(chain(20))), 'quad 20', /depth 20; the limit is 19/);
  });

  test('a real tree with any word changed is refused or stays a tree', async () => {
    const whole = await readPacked(duck, 'duck');
    let refused = 0;
    for (let word = 0; word < whole.texels.length; word++) {
      for (const change of [1, 0x80, 0x80000000]) {
        const file = altered(whole, (texels) => {
          texels[word] ^= change;
        });
        await readPacked(file).catch((error) => {
          expect(error).toMatchObject({ name: 'VextureError', field: expect.stringMatching(/^(quad|curve|texel) \d+$/) });
          refused++;
        });
      }
    }
    expect(refused).toBeGreaterThan(64);
  });
});
