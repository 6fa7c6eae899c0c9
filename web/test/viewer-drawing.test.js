import { describe, expect, it } from 'vitest';
import { drawingsIn, shownDrawing } from '../viewer/drawing.js';

const RED = { color: [1, 0, 0], opacity: 1 };
const BLACK = { color: [0, 0, 0], opacity: 1 };
/** @param {string} name @param {object | null} paint */
const root = (name, paint = null) => ({ name, paint, quad: 0, transform: [1, 0, 0, 0, 1, 0], tolerance: 0, crs: null });

const ATLAS = { roots: [root('cup/1', RED), root('cup/2', BLACK), root('key'), root('ink/1', BLACK), root('a/b')] };

describe('the drawings of a texture', () => {
  it('are its silhouettes and the owners of its layers', () => {
    expect(drawingsIn(ATLAS)).toEqual([
      { name: 'cup', first: 0, count: 2 }, { name: 'key', first: 2, count: 1 }, { name: 'ink', first: 3, count: 1 },
      { name: 'a/b', first: 4, count: 1 },
    ]);
  });

  it.each([
    ['cup', 0, 2, false], ['key', 2, 1, true], ['ink', 3, 1, true], ['a/b', 4, 1, true], ['', 0, 2, false],
    ['there is none', 0, 2, false],
  ])('%j is shown by its own layers', (name, first, count, silhouette) => {
    expect(shownDrawing(/** @type {any} */ (ATLAS), name)).toMatchObject({ first, count, silhouette });
  });
});
