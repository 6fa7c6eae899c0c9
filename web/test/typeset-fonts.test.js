// Fonts of texts: files, fallback, errors; shapes, and restarts of their texture.
import { createServer } from 'node:http';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { describeWithKernels } from './built-kernels.js';
import { ARABIC, CYRILLIC, PACIFICO, fontFile, setText, typesetter } from './typeset-fonts.js';
import { checkForest } from '../src/check-texels.js';
import { loadMaps } from '../src/maps.js';
import { Typesetter } from '../src/typeset/typesetter.js';

describeWithKernels('fonts', () => {
  /** @type {import('node:http').Server} */
  let server;
  let home = '';
  /** @type {string[]} */
  let fetched = [];
  beforeAll(async () => {
    server = createServer((request, response) => {
      const name = request.url.slice(1);
      fetched.push(name);
      const isKnown = [PACIFICO, CYRILLIC, ARABIC].includes(name);
      response.writeHead(isKnown || name === 'empty' ? 200 : 404);
      response.end(isKnown ? Buffer.from(fontFile(name)) : '');
    });
    await new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(null)));
    home = `http://127.0.0.1:${server.address().port}/`;
  });
  afterAll(() => server.close());

  /** @param {(string | ArrayBuffer)[]} sources @param {(string | undefined)[]} [ranges] */
  async function withFonts(sources, ranges = []) {
    const setter = new Typesetter();
    for (const [id, source] of sources.entries()) await setter.answer({ font: { id, source, unicodeRange: ranges[id] } });
    return setter;
  }

  it('are read as WOFF and WOFF2, with the same outlines', async () => {
    const files = [PACIFICO, PACIFICO.replace('.woff', '.woff2')].map(fontFile);
    const setter = await withFonts(files);
    const [woff, woff2] = await Promise.all([0, 1].map((id) => setText(setter, 'Ångström & œuvre', { fonts: [id] })));
    expect(woff2.places).toEqual(woff.places);
    expect(woff2.carets).toEqual(woff.carets);
    expect(woff.missing).toEqual([]);
  });

  it('are fetched when a text needs them', async () => {
    fetched = [];
    const setter = await withFonts([home + PACIFICO, home + CYRILLIC, home + ARABIC], [undefined, 'U+0301, U+4??, u+500-52f', undefined]);
    expect(fetched).toEqual([]);
    const latin = await setText(setter, 'Latin');
    expect(fetched).toEqual([PACIFICO]);
    const mixed = await setText(setter, 'Привет');
    expect(fetched).toEqual([PACIFICO, CYRILLIC]);
    expect(mixed.missing).toEqual([]);
    expect(mixed.added.firstShape).toBe(latin.added.shapes.length);
    expect(mixed.added.shapes.every(({ key }) => key.startsWith('1:'))).toBe(true);
    expect(mixed.added.first).toBe(latin.added.words.length / 4);
    await setText(setter, 'سلام');
    expect(fetched).toEqual([PACIFICO, CYRILLIC, ARABIC]);
  });

  it('that fail are refused in one line, or skipped with a note', async () => {
    const bytes = fontFile(PACIFICO), woff2 = fontFile(CYRILLIC);
    const damaged = new Uint8Array(woff2.slice(0));
    damaged.fill(7, 5000, 6000);
    const wrong = [new ArrayBuffer(0), new TextEncoder().encode('<html>no font at all</html>').buffer, bytes.slice(0, 3000), woff2.slice(0, 60), woff2.slice(0, 5000), damaged.buffer, `${home}none.ttf`, `${home}empty`, 'http://127.0.0.1:1/x.ttf'];
    const setter = await withFonts([...wrong, bytes]);
    const last = wrong.length;
    for (const id of wrong.keys()) {
      const { error, field } = await setText(setter, 'text', { fonts: [id] });
      expect(error, String(id)).toMatch(/; (give|check)/);
      expect(error).not.toMatch(/\n|undefined|please report/);
      expect(field).toMatch(/^(font|url|status 404)$/);
      const { notes, shapes } = await setText(setter, 'text', { fonts: [id, last] });
      expect(notes).toEqual([error]);
      expect(shapes.length).toBe(4);
    }
    expect((await setText(setter, 'a', { fonts: [6] })).error).toBe(`${home}none.ttf: HTTP 404 Not Found; check the address and the server`);
  });

  it('lack characters, which are named once and drawn as .notdef', async () => {
    const { missing, shapes, added } = await setText(typesetter(), '漢Á漢字\u200b\ufe0f', { fonts: [2] });
    expect(missing).toEqual([0x6f22, 0x5b57]);
    expect(added.shapes[0].key).toBe('2::0');
    expect([...shapes]).toEqual([0, 1, 0, 0]);
  });

  it('give marks and joined emoji to the font that has all of them', async () => {
    const { added, missing } = await setText(typesetter(), 'и\u0306', { fonts: [0, 1] });
    expect(added.shapes.every(({ key }) => key.startsWith('1:'))).toBe(true);
    expect(missing).toEqual([]);
  });
});

describeWithKernels('requests', () => {
  const set = (style, text = 'text') => setText(typesetter(), text, style);

  it.each([
    ['text', { text: 7 }, '`text` is 7; give a string'],
    ['text', { text: 'x'.repeat(1_000_001) }, '`text` has 1000001 UTF-16 units; the limit is 1000000; divide it into several texts'],
    ['fonts', { fonts: [] }, '`fonts` is []; give the ids of one font or more'],
    ['fonts', { fonts: [9] }, 'the font 9 is unknown; name it to the worker first'],
    ['fontSize', { fontSize: -1 }, '`fontSize` is -1; give a number from 0 to 1000000000'],
    ['tabSize', { tabSize: -1 }, '`tabSize` is -1; give a number from 0 to 1000000000'],
    ['maxWidth', { maxWidth: -1 }, '`maxWidth` is -1; give a number from 0 to 1000000000'],
    ['letterSpacing', { letterSpacing: Number.NaN }, null],
    ['textAlign', { textAlign: 'middle' }, '`textAlign` is "middle"; it must be one of left, right, center, justify, start, end'],
    ['anchorY', { anchorY: 'baseline' }, null],
    ['fontFeatures', { features: 'small caps' }, '`fontFeatures` has "small caps"; write tags of four letters, such as \'smcp, ss01=2\''],
    ['lang', { language: 'a b' }, '`lang` is "a b"; give a tag such as \'sr\' or \'zh-Hant\''],
    ['fontWeight', { weight: 'bold' }, '`fontWeight` has "bold" for "wght"; give a number'],
    ['fontVariations', { variations: { wdth: 'narrow' } }, '`fontVariations` has "narrow" for "wdth"; give a number'],
  ])('with a wrong %s are refused', async (field, style, message) => {
    const found = await set(style);
    if (message) expect(found).toMatchObject({ error: message, field });
    else expect(found.field ?? 'none').toBe(field === 'letterSpacing' ? 'none' : field);
  });

  it('of no size show nothing', async () => {
    const found = await set({ fontSize: 0, outlineWidth: 0.1, strokeWidth: 0.1, maxWidth: 3 }, 'no\tsize\nat all');
    expect(found).toMatchObject({ visibleBounds: [0, 0, 0, 0], lineHeight: 0, missing: [] });
    expect(found.shapes.length).toBe(0);
    expect(found.lines.length).toBe(2);
    expect([...found.carets, ...found.blockBounds].every((value) => value === 0)).toBe(true);
  });

  it('refused leave the others in peace', async () => {
    const { reply } = await typesetter().answer({ id: 5, texts: [{ text: 1 }, null, { text: 'ab', fonts: [0] }] });
    expect(reply.id).toBe(5);
    expect(reply.results.map((one) => 'error' in one)).toEqual([true, true, false]);
  });

  it('of nothing have one empty line', async () => {
    const { shapes, carets, lines, blockBounds, visibleBounds } = await set({}, '');
    expect([shapes.length, carets.length, lines.length]).toEqual([0, 4, 1]);
    expect(blockBounds[1]).toBeLessThan(0);
    expect(visibleBounds).toEqual([0, 0, 0, 0]);
  });
});

describeWithKernels('shapes', () => {
  it('are converted once, before the texts that show them', async () => {
    const setter = typesetter();
    const { reply } = await setter.answer({ id: 1, preload: { fonts: [0], characters: 'abc' } });
    expect(reply.results).toEqual([]);
    expect(reply.added.shapes.length).toBe(3);
    const again = await setText(setter, 'abc', { fonts: [0] });
    expect(again.added.shapes).toEqual([]);
    expect(again.added).toMatchObject({ firstShape: 3, first: reply.added.words.length / 4 });
  });

  it('are numbered again after a restart, with the same texels', async () => {
    const setter = typesetter();
    const before = await setText(setter, 'ab سب', { outlineWidth: 0.04, strokeWidth: 0.02 });
    await loadMaps();
    checkForest(before.added.words, before.added.shapes);
    const keys = before.added.shapes.map(({ key }) => key);
    const { reply } = await setter.answer({ id: 2, restart: { keys } });
    expect(reply).toMatchObject({ id: 2, restarted: true });
    expect(reply.added).toEqual(before.added);
    const some = (await setter.answer({ id: 3, restart: { keys: ['9::1', 'nonsense', keys[2], keys[0]] } })).reply.added;
    expect(some.shapes.map(({ key }) => key)).toEqual([keys[2], keys[0]]);
    expect(some).toMatchObject({ first: 0, firstShape: 0 });
    const after = await setText(setter, 'ab سب');
    expect(after.added.firstShape).toBe(2);
    expect(after.places).toEqual(before.places);
  });

  it('of colour fonts are maps, unless the text gives the colour', async () => {
    const { added, notes } = await setText(typesetter(), 'ش ل', { fonts: [2] });
    const maps = added.shapes.filter(({ isMap }) => isMap);
    expect(maps.length).toBeGreaterThan(0);
    expect(maps.length).toBeLessThan(added.shapes.length);
    expect(notes).toEqual([]);
    await loadMaps();
    checkForest(added.words, added.shapes);
  });

  it('have outlines that are wider, and strokes along their edges', async () => {
    const { places, outlines, strokes, shapes } = await setText(typesetter(), 'o', { fontSize: 2, outlineWidth: 0.1, strokeWidth: 0.04 });
    expect(outlines.shapes.length).toBe(shapes.length);
    expect(outlines.places[0]).toBeCloseTo(places[0] - 0.1, 3);
    expect(outlines.places[2]).toBeCloseTo(places[2] + 0.2, 3);
    expect(strokes.places[2]).toBeCloseTo(places[2] + 0.04, 3);
  });
});
