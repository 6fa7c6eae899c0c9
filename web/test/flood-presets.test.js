import { describe, expect, it } from 'vitest';
import { FIELD, between, planHeight, pose, sunOver, wholes } from '../flood/presets.js';

/** Land in the north, a shore along the middle, the sea in the south. @type {import('../flood/presets.js').Stand} */
const STAND = {
  width: 100, depth: 75, low: -12, high: 8, aspect: 1.6, share: 0.9,
  height: (_, z) => Math.max(0, -z / 5),
  ground: (_, z) => -z / 5,
};

/** A view of that shore. @param {'far' | 'near' | 'eye'} kind @param {number} away */
const at = (kind, away, above = 0) => /** @type {import('../flood/presets.js').View} */ (
  { name: kind, kind, place: [5, 0], toward: [0, 1], away, above: () => above });
const [PLAN, OVERVIEW] = wholes([0, 1]);
const BEACH = at('eye', 0);
const VIEWS = [PLAN, OVERVIEW, at('far', 44), at('near', 14), BEACH];

/** Where a place is in the picture, -1..1. @param {import('../flood/presets.js').Pose} seen @param {number[]} place */
function projected({ from, to }, place, aspect = STAND.aspect) {
  const minus = (/** @type {number[]} */ a, /** @type {number[]} */ b) => a.map((one, at) => one - b[at]);
  const dot = (/** @type {number[]} */ a, /** @type {number[]} */ b) =>
    a.reduce((sum, one, at) => sum + one * b[at], 0);
  const cross = ([a, b, c] = [0, 0, 0], [d, e, f] = [0, 0, 0]) => [b * f - c * e, c * d - a * f, a * e - b * d];
  const unit = (/** @type {number[]} */ a) => a.map((one) => one / Math.hypot(...a));
  const eye = [from.x, from.y, from.z];
  const ahead = unit(minus([to.x, to.y, to.z], eye));
  const right = unit(cross(ahead, [0, 1, 0]));
  const up = cross(right, ahead);
  const far = minus(place, eye);
  const slope = Math.tan((FIELD * Math.PI) / 360) * dot(far, ahead);
  return [dot(far, right) / slope / aspect, dot(far, up) / slope];
}

const corners = [-50, 50].flatMap((x) => [-12, 8].flatMap((y) => [-37.5, 37.5].map((z) => [x, y, z])));

describe('pose', () => {
  it.each([PLAN, OVERVIEW])('$name shows the whole box, as large as it can be', (view) => {
    for (const aspect of [0.5, 1.6]) {
      const stand = { ...STAND, aspect };
      // the free part of the picture is as much lower as it is narrower: its shape is the aspect
      const seen = corners.map((corner) => projected(pose(view, stand), corner, aspect));
      const most = Math.max(...seen.flat().map(Math.abs)) / STAND.share;
      expect(most).toBeLessThan(1);
      expect(most).toBeGreaterThan(0.9);
    }
  });

  it('comes nearer from each to the next', () => {
    const away = VIEWS.map((view) => {
      const { from } = pose(view, STAND);
      return Math.hypot(from.x - 5, from.y, from.z);
    });
    const [plan, ...others] = away;
    expect(others).toEqual([...others].sort((a, b) => b - a));
    expect(plan).toBeGreaterThan(others[1]);
  });

  it('stands on the beach, and looks over the water', () => {
    const { from, to } = pose(BEACH, STAND);
    expect(from.z).toBeLessThan(0);
    expect(from.y).toBeGreaterThan(STAND.height(from.x, from.z));
    expect(from.y - STAND.height(from.x, from.z)).toBeLessThan(1);
    expect(to.z).toBeGreaterThan(5);
  });

  it('never stands in a hill', () => {
    const steep = { ...STAND, height: () => 9 };
    for (const view of VIEWS) expect(pose(view, steep).from.y).toBeGreaterThan(9);
  });

  it('stands above the highest water of all times', () => {
    for (const kind of /** @type {const} */ (['far', 'near', 'eye'])) {
      expect(pose(at(kind, 5, 30), STAND).from.y).toBeGreaterThan(30);
    }
  });

  it('looks to the same side at all times, and to the land even where all of it is below the highest water', () => {
    for (const side of [1, -1]) { // a polder in the east, or in the west
      const isLand = (/** @type {number} */ x) => side * (x - 5) > 0;
      const ground = (/** @type {number} */ x) => (isLand(x) ? -1 : -20);
      const dry = { ...STAND, ground, height: (/** @type {number} */ x) => (isLand(x) ? -1 : 0) };
      const drowned = { ...STAND, ground, height: (/** @type {number} */ x) => (isLand(x) ? 4 : 4.001) };
      for (const kind of /** @type {const} */ (['far', 'near'])) {
        const seen = [dry, drowned].map((stand) => pose(at(kind, 20, 4), stand).from.x - 5);
        expect(side * seen[0]).toBeLessThan(0); // from over the sea
        expect(seen[1]).toBeCloseTo(seen[0]);
      }
    }
  });

  it('has a plan in which the box fits, and is as large as it can be', () => {
    for (const aspect of [0.5, 1.6]) {
      const half = planHeight({ ...STAND, aspect });
      const filled = Math.max(37.5 / half, 50 / half / aspect) / STAND.share;
      expect(filled).toBeLessThan(1);
      expect(filled).toBeGreaterThan(0.9);
    }
  });

  it('has the sun over the water that the beach looks at', () => {
    const sun = sunOver(BEACH, STAND);
    expect(Math.hypot(sun.x, sun.y, sun.z)).toBeCloseTo(1);
    expect(sun.z).toBeGreaterThan(0.5);
    expect(sun.y).toBeGreaterThan(0.3);
  });
});

describe('between', () => {
  const [start, end] = [pose(PLAN, STAND), pose(BEACH, STAND)];

  it('begins and ends where it should', () => {
    for (const [share, wanted] of /** @type {const} */ ([[0, start], [1, end], [2, end]])) {
      const { from, to } = between(start, end, share);
      for (const axis of /** @type {const} */ (['x', 'y', 'z'])) {
        expect(from[axis]).toBeCloseTo(wanted.from[axis]);
        expect(to[axis]).toBeCloseTo(wanted.to[axis]);
      }
    }
  });

  it('stays above the lower end, and turns the short way round', () => {
    const left = { from: { x: 1, y: 1, z: -9 }, to: { x: 0, y: 0, z: 0 } };
    const right = { from: { x: -1, y: 1, z: -9 }, to: { x: 0, y: 0, z: 0 } };
    for (let share = 0; share <= 1; share += 0.05) {
      expect(between(start, end, share).from.y).toBeGreaterThanOrEqual(end.from.y - 1e-9);
      expect(between(left, right, share).from.z).toBeLessThan(-8);
    }
  });
});
