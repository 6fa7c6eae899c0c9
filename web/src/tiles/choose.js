// Which tile of a pyramid each part of a view shows now, and which tiles are to be loaded, in which order. Plain data.
import { ancestor, keyOf, zoomsTo } from './grid.js';

/**
 * @typedef {import('./grid.js').TileId} TileId
 *
 * @typedef {TileId & { wrap?: number, distance?: number }} Quad A part of a view: a tile of the grid, at the zoom that the
 *   view has there. `distance` from what is looked at, in any unit
 *
 * @typedef {'ready' | 'empty' | 'failed' | undefined} State of a tile; undefined: not there, or not yet
 *
 * @typedef {object} Shown What a part of the view shows.
 * @property {Quad} quad
 * @property {TileId} tile the quad itself, or one that holds it
 *
 * @typedef {object} Wanted A tile that the view needs.
 * @property {TileId} tile
 * @property {string} key
 * @property {number} rank of the tile: those above it come first
 * @property {number} distance of the nearest of its parts
 *
 * @typedef {Wanted & { quads: Quad[], children: Map<string, Node> }} Node A tile, and those below it that are wanted.
 */

/**
 * Choose the tiles of a view. Quads below a tile change to its children together: while one of these is not there, all
 * show the tile, so that nothing is blank and no two levels of detail meet where there was one.
 *
 * @param {Quad[]} quads of the view, apart from one another
 * @param {readonly number[]} zooms that the pyramid has, rising
 * @param {(key: string) => State} stateOf
 * @returns {{ shown: Shown[], wanted: Wanted[] }} the latter with all that are there already, the most urgent first
 */
export function choose(quads, zooms, stateOf) {
  /** @type {Map<string, Node>} */
  const nodes = new Map();
  /** @type {Map<string, Node>} */
  const roots = new Map();
  for (const quad of quads) insert(quad, zooms, nodes, roots);
  /** @type {Shown[]} */
  const shown = [];
  for (const root of roots.values()) show(root, null, stateOf, shown);
  const wanted = [...nodes.values()].sort((one, other) => one.rank - other.rank || one.distance - other.distance);
  return { shown, wanted };
}

/**
 * @param {Quad} quad
 * @param {readonly number[]} zooms
 * @param {Map<string, Node>} nodes
 * @param {Map<string, Node>} roots
 */
function insert(quad, zooms, nodes, roots) {
  let siblings = roots;
  /** @type {Node | undefined} */
  let node;
  const distance = quad.distance ?? 0;
  zoomsTo(zooms, quad.z).forEach((z, rank) => {
    const tile = ancestor(quad, z);
    const key = keyOf(tile);
    node = nodes.get(key) ?? { tile, key, rank, distance, quads: [], children: new Map() };
    node.distance = Math.min(node.distance, distance);
    nodes.set(key, node);
    siblings.set(key, node);
    siblings = node.children;
  });
  node?.quads.push(quad);
}

/**
 * @param {Node} node
 * @param {TileId | null} above the nearest tile above it that is there
 * @param {(key: string) => State} stateOf
 * @param {Shown[]} shown
 */
function show(node, above, stateOf, shown) {
  const state = stateOf(node.key);
  const tile = state === 'ready' ? node.tile : state === 'empty' ? null : above;
  if (tile) for (const quad of node.quads) shown.push({ quad, tile });
  const children = [...node.children.values()];
  if (!tile || children.every(({ key }) => stateOf(key))) for (const child of children) show(child, tile, stateOf, shown);
  else for (const child of children) for (const quad of quadsOf(child)) shown.push({ quad, tile });
}

/** @param {Node} node @returns {Quad[]} */
const quadsOf = (node) => [...node.quads, ...[...node.children.values()].flatMap(quadsOf)];
