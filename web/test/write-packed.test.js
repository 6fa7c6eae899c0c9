import { describe, expect, test } from 'vitest';
import { readKtx2 } from '../src/ktx2.js';
import { readPacked } from '../src/packed.js';
import { writePacked } from '../src/convert/write-packed.js';
import { fixture } from './files.js';

describe('writePacked', () => {
  test.each(['duck', 'drawings', 'elements', 'maps', 'shades'])('writes what a loader reads back: %s', async (name) => {
    const data = await readPacked(fixture(`${name}.ktx2`), 'file');
    expect(await readPacked(await writePacked(data), 'file')).toEqual(data);
  });

  test('describes the words of the texels as Python does', async () => {
    const file = fixture('duck.ktx2');
    const written = await writePacked(await readPacked(file, 'duck'));
    const descriptor = (bytes) => bytes.slice(104, 104 + new DataView(bytes.buffer, bytes.byteOffset).getUint32(52, true));
    expect(descriptor(written)).toEqual(descriptor(file));
    expect((await readKtx2(written)).texts.get('KTXwriter')).toMatch(/^vexture/);
  });

  test('keeps long styles, which are deflated', async () => {
    const data = await readPacked(fixture('elements.ktx2'), 'file');
    const [root] = data.roots;
    const elements = Array.from({ length: 100 }, (_, k) => ({ ...root.style.elements[0], name: `element ${k}`, hides: k % 2 === 0 }));
    const long = { ...data, roots: [{ ...root, style: { ...root.style, elements, groups: [] } }] };
    long.roots[0].style.elements.forEach((one) => (one.group = -1));
    const read = await readPacked(await writePacked(long), 'file');
    expect(read.roots[0].style.elements).toEqual(elements);
  });
});
