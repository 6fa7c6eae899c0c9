import { describe, expect, it } from 'vitest';
import { isStep, labelOf, stepsAmong } from '../flood/steps.js';

describe('steps of a server', () => {
  it('are the shapes whose names begin so', () => {
    expect(['flood', 'flood/01', 'flooded', 'flood-2', 'x/flood'].map((name) => isStep(name, 'flood')))
      .toEqual([true, true, false, false, false]);
  });

  it('come in the order of their numbers, each once', () => {
    const names = ['flood/10', 'duck', 'flood/9', 'flood/9', 'flood'];
    expect(stepsAmong(names, 'flood')).toEqual(['flood/9', 'flood/10', 'flood']);
  });
});

describe('labelOf', () => {
  const manifest = (/** @type {import('../flood/page-data.js').Facts} */ facts) => ({ name: 'flood', texture: '', facts });

  it('is what the step says, its time, or its name', () => {
    expect(labelOf(manifest({ label: '06:00', time: '2026-01-05T06:00:00Z' }), 'flood')).toBe('06:00');
    expect(labelOf(manifest({ label: '', time: '2026-01-05T06:30:00Z' }), 'flood')).toBe('2026-01-05 06:30 UTC');
    expect(labelOf(manifest({}), 'flood/3')).toBe('flood/3');
  });
});
