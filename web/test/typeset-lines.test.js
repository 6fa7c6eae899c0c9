// Lines of texts: breaks, alignment, anchors, direction and carets.
import { beforeAll, expect, it } from 'vitest';
import { describeWithKernels } from './built-kernels.js';
import { setText, typesetter } from './typeset-fonts.js';

describeWithKernels('lines', () => {
  /** @type {import('../src/typeset/typesetter.js').Typesetter} */
  let setter;
  const set = (text, style) => setText(setter, text, style);
  const linesOf = async (text, style) => (await set(text, style)).lines.map(({ first, end }) => text.slice(first, end));
  const caret = ({ carets }, index) => Array.from(carets.slice(4 * index, 4 * index + 2));
  beforeAll(() => {
    setter = typesetter();
  });

  it('break where words end, and at line ends', async () => {
    expect(await linesOf('one two three four', { maxWidth: 4 })).toEqual(['one two ', 'three ', 'four']);
    expect(await linesOf('one two three four', { maxWidth: 4, whiteSpace: 'nowrap' })).toEqual(['one two three four']);
    expect(await linesOf('a\nb\r\n\u2028c', { maxWidth: 4 })).toEqual(['a', 'b', '', 'c']);
    expect(await linesOf('well-known (see) 1,000.5 km', { maxWidth: 0.1 })).toEqual(['well-', 'known ', '(see) ', '1,000.5 ', 'km']);
    expect(await linesOf('')).toEqual(['']);
    expect(await linesOf('   ', { maxWidth: 0.1 })).toEqual(['   ']);
  });

  it('break long words only if they may, between user-perceived characters', async () => {
    expect(await linesOf('abcdef', { maxWidth: 1 })).toEqual(['abcdef']);
    const parts = await linesOf('ae\u0301e\u0301e\u0301e\u0301e\u0301', { maxWidth: 1, overflowWrap: 'break-word' });
    expect(parts.length).toBeGreaterThan(1);
    expect(parts.every((part) => !part.startsWith('\u0301'))).toBe(true);
    expect(await linesOf('abc', { maxWidth: 0, overflowWrap: 'break-word' })).toEqual(['a', 'b', 'c']);
    expect(await linesOf('to abcdefgh', { maxWidth: 2, overflowWrap: 'break-word' })).toEqual(['to ', 'abcd', 'efgh']);
  });

  it('end with a hyphen where a soft one is, and nowhere else', async () => {
    const [broken, whole] = await Promise.all([set('soft\u00adly', { maxWidth: 1.7 }), set('soft\u00adly')]);
    expect(broken.lines.map(({ end }) => end)).toEqual([5, 7]);
    expect(broken.shapes.length).toBe(whole.shapes.length + 1);
    expect([...broken.clusters]).toContain(4);
    expect(broken.lines[0].right).toBeGreaterThan((await set('soft')).lines[0].right + 0.1);
  });

  it('have tabs that lead to stops', async () => {
    const space = caret(await set(' '), 0)[1], stop = 8 * space;
    const starts = async (text, style) => {
      const found = await set(text, style);
      return [...text.matchAll(/\t+/g)].map(({ index, 0: { length } }) => caret(found, index + length - 1)[1]);
    };
    const near = (...values) => values.map((value) => expect.closeTo(value, 5));
    expect(await starts('a\tb\tc')).toEqual(near(stop, 2 * stop));
    expect(await starts('\t\tb')).toEqual(near(2 * stop));
    expect(await starts('\tb', { tabSize: 2 })).toEqual(near(2 * space));
    expect(await starts('a\tb', { tabSize: 0 })).toEqual(near((await set('a')).lines[0].right));
    const wide = (await set('mmmmm')).lines[0].right;
    expect(wide).toBeGreaterThan(stop);
    expect(await starts('mmmmm\tb')).toEqual(near(Math.ceil(wide / stop + 0.5 / 8) * stop));
    expect(await starts('a\tb', { fontSize: 3, letterSpacing: 0.5 })).toEqual(near(8 * (3 * space + 0.5)));
    const { lines } = await set('a\tb\tc\td', { maxWidth: 2.5 * stop });
    expect(lines.map(({ first }) => first)).toEqual([0, 6]);
    const hebrew = await set('א\tב', { fonts: [0] });
    expect(hebrew.lines[0].right - caret(hebrew, 2)[0]).toBeCloseTo(stop, 5);
  });

  it('are no wider than allowed', async () => {
    const { lines } = await set('The quick brown fox jumps over the lazy dog, and over the fence', { maxWidth: 5, fontSize: 0.7 });
    expect(lines.length).toBeGreaterThan(3);
    for (const { left, right } of lines) expect(right - left).toBeLessThanOrEqual(5 + 1e-6);
  });

  it('are aligned in the block of the longest', async () => {
    const text = 'wide wide wide\nnarrow';
    const left = await set(text), { blockBounds } = left, width = blockBounds[2];
    expect(left.lines.map((line) => line.left)).toEqual([0, 0]);
    const right = await set(text, { textAlign: 'right' });
    expect(right.lines.map((line) => line.right)).toEqual([expect.closeTo(width, 6), expect.closeTo(width, 6)]);
    const center = await set(text, { textAlign: 'center' });
    expect(center.lines[1].left + center.lines[1].right).toBeCloseTo(width, 6);
    const indented = await set(text, { textIndent: 2 });
    expect(indented.lines.map((line) => line.left)).toEqual([2, 2]);
  });

  it('are stretched between words, but not the last', async () => {
    const text = 'a few words of a paragraph', { lines, carets } = await set(text, { maxWidth: 5, textAlign: 'justify' });
    expect(lines.length).toBeGreaterThan(2);
    for (const line of lines.slice(0, -1)) expect(line.right - line.left).toBeCloseTo(5, 5);
    expect(lines.at(-1).right).toBeLessThan(5);
    const [start, end] = caret({ carets }, 1), [left, right] = caret({ carets }, 0);
    const plain = caret(await set(text, { maxWidth: 5 }), 1);
    expect(end - start).toBeGreaterThan(plain[1] - plain[0]);
    expect(right - left).toBeCloseTo((await set('a')).lines[0].right, 5);
  });

  it('are anchored', async () => {
    const text = 'one\ntwo', { blockBounds: [, bottom, width], lines, capHeight, xHeight } = await set(text);
    const origin = async (anchorX, anchorY) => (await set(text, { anchorX, anchorY })).blockBounds;
    expect(await origin('center', 'middle')).toEqual([-width / 2, bottom / 2, width / 2, -bottom / 2].map((one) => expect.closeTo(one, 6)));
    expect((await origin('100%', '25%')).slice(0, 2)).toEqual([expect.closeTo(-width, 6), expect.closeTo(0.75 * bottom, 6)]);
    expect((await origin(0.5, 0.25)).slice(2)).toEqual([expect.closeTo(width - 0.5, 6), -0.25]);
    for (const [anchorY, baseline] of [['top-baseline', 0], ['top-cap', -capHeight], ['top-ex', -xHeight]]) {
      expect((await set(text, { anchorY })).lines[0].baseline).toBeCloseTo(baseline, 6);
    }
    expect((await set(text, { anchorY: 'bottom-baseline' })).lines[1].baseline).toBeCloseTo(0, 6);
    expect((await set(text, { anchorY: 'bottom' })).blockBounds[1]).toBeCloseTo(0, 6);
    const tall = await set(text, { lineHeight: 3, fontSize: 2 });
    expect(tall.lines[0].baseline - tall.lines[1].baseline).toBeCloseTo(6, 6);
    expect(lines[0].baseline - lines[1].baseline).toBeCloseTo((await set('x')).lineHeight, 6);
  });

  it('run in the order of UAX 9', async () => {
    const text = 'abc \u0633\u0644\u0627\u0645 def'; // a word in Arabic
    const mixed = await set(text), [first] = caret(mixed, 4), [last] = caret(mixed, 7);
    expect(first).toBeGreaterThan(last);
    expect(caret(mixed, 9)[0]).toBeGreaterThan(first - 1e-6);
    const reversed = await set(text, { direction: 'rtl' });
    expect(caret(reversed, 0)[0]).toBeGreaterThan(caret(reversed, 9)[0]);
    expect((await set('\u0633\u0644 x', { direction: 'auto', textAlign: 'start', maxWidth: 0.1 })).lines[1].right).toBeCloseTo((await set('\u0633\u0644')).lines[0].right, 5);
  });

  it('hang the spaces at their ends on the side where the text ends', async () => {
    const hebrew = '\u0633\u0644 \u0633', { lines, carets } = await set(hebrew, { maxWidth: 0.1 });
    expect(lines[0].left).toBeGreaterThanOrEqual(-1e-6);
    expect(caret({ carets }, 2)[1]).toBeLessThan(lines[0].left);
  });

  it('have the space at their end on the side of their paragraph, after a word of the other direction', async () => {
    const text = 'abc \u0633\u0644\u0627 \u0633\u0644', width = (await set(text.slice(0, 7))).lines[0].right + 0.01;
    const broken = await set(text, { maxWidth: width });
    expect(broken.lines.map(({ end }) => end)).toEqual([8, 10]);
    expect(caret(broken, 7)[0]).toBeGreaterThanOrEqual(caret(broken, 4)[0] - 1e-6);
    expect(broken.lines[0].right).toBeCloseTo(caret(broken, 4)[0], 5);
  });

  it('keep characters beyond the first plane in their direction', async () => {
    const emoji = await set('\u0633\u{1f600}\u0644'); // an emoji, which is neutral
    expect(caret(emoji, 0)[0]).toBeGreaterThan(caret(emoji, 1)[0]);
    expect(caret(emoji, 1)[0]).toBeGreaterThan(caret(emoji, 3)[0]);
    expect(caret(emoji, 1)).toEqual(caret(emoji, 2));
    expect(emoji.missing).toEqual([0x1f600]);
    const adlam = await set('\u{1e900}\u{1e901}'); // letters from right to left
    expect(caret(adlam, 0)[0]).toBeGreaterThan(caret(adlam, 2)[0]);
  });

  it('have carets that divide ligatures, and one at the end', async () => {
    const { carets, lines, clusters } = await set('affi');
    const starts = [0, 1, 2, 3, 4].map((index) => carets[4 * index]);
    expect([...starts].sort((a, b) => a - b)).toEqual(starts);
    expect(new Set(starts).size).toBe(5);
    expect(starts[4]).toBeCloseTo(lines[0].right, 6);
    expect(clusters[0]).toBe(0);
    const two = await set('a\nb');
    expect(caret(two, 1)).toEqual([expect.closeTo(two.lines[0].right, 6), expect.closeTo(two.lines[0].right, 6)]);
    expect(two.carets[4 * 1 + 3]).toBeGreaterThan(two.carets[4 * 2 + 3]);
    expect(caret(two, 3)[0]).toBeCloseTo(two.lines[1].right, 6);
  });

  it('have room between letters, but not between those that join', async () => {
    const [plain, spread] = await Promise.all([set('ab'), set('ab', { letterSpacing: 0.5 })]);
    expect(spread.lines[0].right - plain.lines[0].right).toBeCloseTo(1, 6);
    const [joined, apart] = await Promise.all([set('\u0633\u0644'), set('\u0633\u0644', { letterSpacing: 0.5 })]);
    expect(apart.lines[0].right).toBeCloseTo(joined.lines[0].right, 6);
  });

  it('go from top to bottom, Latin turned', async () => {
    const { lines, places, blockBounds, carets, added } = await set('ab\nc', { writingMode: 'vertical-rl', lineHeight: 2 });
    expect(blockBounds[2] - blockBounds[0]).toBeCloseTo(4, 6);
    expect(lines.map(({ baseline }) => baseline)).toEqual([expect.closeTo(3, 6), expect.closeTo(1, 6)]);
    expect(places[1]).toBeGreaterThan(places[4]);
    expect(carets[0]).toBeGreaterThan(carets[4]);
    expect(added.shapes.every(({ key }) => key.endsWith(':r'))).toBe(true);
  });
});
