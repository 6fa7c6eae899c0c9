import { describe, expect, it } from 'vitest';
import { START, State, decodeView, encodeView } from '../viewer/state.js';

const SEEN = {
  ...START, shape: 'a~b/ü & %', drawing: 'tea, cup', center: [0.1234567890123456, 1 / 3], zoom: 9876.54321, mode: 'cube',
  yaw: -1.25, pitch: 0.5, distance: 3, theme: 'dark', background: '#12ab9f', compare: 'raster', split: 0.31,
  overlays: { cells: true, coverage: false, depth: true, cutoff: 2.5, inspect: false, contents: true },
};

describe('a link', () => {
  it('holds all that is seen, to the last bit', () => {
    expect(decodeView(encodeView(SEEN))).toEqual(SEEN);
    expect(decodeView(encodeView(START))).toEqual(START);
  });

  it('from before backgrounds could be chosen shows the first of them', () => {
    const { background, ...rest } = SEEN;
    const old = encodeView(SEEN).replace(`~${encodeURIComponent(background)}`, '');
    expect(decodeView(old)).toEqual({ ...rest, background: 'white' });
  });

  it('needs no escaping in a URL', () => {
    const url = new URL('http://localhost/');
    url.hash = `view=${encodeView(SEEN)}`;
    expect(url.hash).toBe(`#view=${encodeView(SEEN)}`);
    expect(encodeView(SEEN)).toMatch(/^[\w~.!'()*%-]+$/);
  });

  it.each([
    ['empty', ''],
    ['of another version', encodeView(START).replace(/^1~/, '9~')],
    ['cut off', encodeView(START).slice(0, -8)],
    ['longer', `${encodeView(START)}~1`],
    ['with an escape that is none', encodeView(START).replace('~~', '~%E0%A4%A~')],
    ['with a surface that there is not', encodeView(START).replace('flat', 'torus')],
    ['with a background that there is not', encodeView({ ...START, background: '#12ab9' })],
    ['with a number that is none', encodeView(START).replace('0.5~0.5', '0.5~NaN')],
    ['without a number', encodeView(START).replace('0.5~0.5', '0.5~')],
    ['with a zoom beyond the limits', encodeView({ ...START, zoom: 1e9 })],
  ])('that is %s is refused', (_, text) => {
    expect(decodeView(text)).toBeNull();
  });
});

describe('the state', () => {
  it('says what changed, and nothing when nothing did', () => {
    const state = new State();
    const heard = [];
    state.addEventListener('change', (event) => heard.push([...event.detail.changed]));
    state.update({ zoom: 2, mode: 'flat' });
    state.update({ zoom: 2 });
    state.updateOverlays({ cells: true });
    state.updateOverlays({ cells: true });
    expect(heard).toEqual([['zoom'], ['overlays']]);
  });

  it('keeps within its limits', () => {
    const state = new State();
    state.update({ zoom: 1e12, center: [-3, 2], split: 7, pitch: 9, yaw: 7 });
    const { zoom, center, split, pitch, yaw } = state.value;
    expect([zoom, ...center, split, pitch]).toEqual([50000, 0, 1, 1, Math.PI / 2]);
    expect(yaw).toBeCloseTo(7 - 2 * Math.PI, 12);
  });
});
