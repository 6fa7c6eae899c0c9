// Texts in Node.js: the font of the package is read from its file.
import { afterAll, beforeAll, expect, it } from 'vitest';
import { describeWithKernels } from './built-kernels.js';
import { PACIFICO, fontFile } from './typeset-fonts.js';
import { Glyphs, NOTO_SANS, Text, setDefaultFont } from '../src/text/index.js';

describeWithKernels('texts in Node.js', () => {
  /** @type {Glyphs} */
  let glyphs;
  beforeAll(() => {
    glyphs = new Glyphs({ worker: false });
  });
  afterAll(() => setDefaultFont(null));

  const fontsOf = async (options) => {
    const text = new Text({ glyphs, ...options });
    await text.sync();
    return [...text.layout.shapes].map((shape) => glyphs.texture.roots[shape].name.split(':')[0]);
  };

  it('are in the font of the package by default', async () => {
    const text = new Text({ glyphs, text: 'Zoë λ' });
    await text.sync();
    expect(text.layout.missing).toEqual([]);
    expect(text.layout.visibleBounds[2]).toBeGreaterThan(1);
  });

  it('take the font of the package where another one lacks a character', async () => {
    const font = [fontFile(PACIFICO), NOTO_SANS];
    const [latin, greek] = await fontsOf({ text: 'aλ', font });
    expect(latin).not.toBe(greek);
    setDefaultFont(font);
    expect(await fontsOf({ text: 'aλ' })).toEqual([latin, greek]);
    expect(await fontsOf({ text: 'aλ', fontWeight: 'bold', fontStyle: 'italic' })).toEqual([latin, greek]);
  });

  it.each([Infinity, -Infinity, 0, -0])('are straight with a radius of %s', async (curveRadius) => {
    const [straight, bent] = [new Text({ glyphs, text: 'abc' }), new Text({ glyphs, text: 'abc', curveRadius })];
    await Promise.all([straight.sync(), bent.sync()]);
    expect(bent.geometry.attributes.vextureGlyph.array).toEqual(straight.geometry.attributes.vextureGlyph.array);
    expect(bent.geometry.isBent).toBe(false);
    expect(bent.geometry.boundingSphere.radius).toBeGreaterThan(0.5);
  });

  it('of no size show nothing, until they have one', async () => {
    const text = new Text({ glyphs, text: 'abc', fontSize: 0, outlineWidth: '10%', strokeWidth: 0.1 });
    await text.sync();
    expect(text.geometry.instanceCount).toBe(0);
    text.fontSize = 1;
    await text.sync();
    expect(text.geometry.instanceCount).toBe(3);
  });

  it('name a file that is not there', async () => {
    const text = new Text({ glyphs, text: 'a', font: new URL('nothing.woff', import.meta.url) });
    await expect(text.sync()).rejects.toThrow(/nothing\.woff: cannot be read .*; check the address$/);
  });
});
