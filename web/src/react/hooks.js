// What the components of React Three Fiber have in common.
import { useFrame, useThree } from '@react-three/fiber';
import { useEffect, useLayoutEffect, useMemo, useReducer, useRef } from 'react';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */
/** @typedef {import('../vector-mask.js').VectorMask} VectorMask */

/**
 * A function that applies to a target what is other than the last time, and asks for a frame.
 *
 * @returns {(target: unknown, values: Map<string, any>, gone: unknown, apply: (changes: Map<string, any>) => void) => void}
 *   a name that is missing now gets the value `gone`
 */
export function useChanges() {
  const last = useRef({ target: /** @type {unknown} */ (null), values: new Map() });
  const invalidate = useThree((state) => state.invalidate);
  return (target, values, gone, apply) => {
    const before = last.current.target === target ? last.current.values : new Map();
    const changes = new Map([...values].filter(([name, value]) => !before.has(name) || before.get(name) !== value));
    for (const name of before.keys()) if (!values.has(name)) changes.set(name, gone);
    if (changes.size > 0) {
      apply(changes);
      invalidate();
    }
    last.current = { target, values };
  };
}

/**
 * The texture to show: a copy with other colours, if there are some.
 *
 * @param {VectorTexture | null} texture
 * @param {import('../paints.js').PaintList | null | undefined} colors
 * @param {import('../select-root.js').RootChoice} root
 */
export function useColors(texture, colors, root) {
  const invalidate = useThree((state) => state.invalidate);
  const change = useChanges();
  const [news, follow] = useReducer((/** @type {number} */ count) => count + 1, 0);
  const copy = useMemo(() => (colors && texture ? texture.clone() : null), [texture, !colors, news]);
  useLayoutEffect(() => {
    if (!copy || !colors) return;
    const list = new Map(colors instanceof Map ? colors : Object.entries(colors));
    change(copy, list, 'own', (changes) => copy.setPaints(changes, root));
  });
  useEffect(() => () => copy?.dispose(), [copy]);
  useEffect(() => {
    const onChange = () => (copy ? follow() : invalidate());
    texture?.addEventListener('change', onChange);
    return () => texture?.removeEventListener('change', onChange);
  }, [texture, copy]);
  return copy ?? texture;
}

/** What has a material in React's tree. @param {any} material @returns {any} */
export function meshOf(material) {
  const parent = material?.__r3f?.parent;
  return parent?.object ?? parent; // in version 8 it is the mesh itself
}

/**
 * Attach a mask to its mesh, and another one when they change.
 *
 * @param {() => { mask: VectorMask | null | undefined, mesh: any }} find
 * @returns {() => void} does so at once
 */
export function useMesh(find) {
  const held = useRef(/** @type {{ mask?: VectorMask | null, mesh?: any }} */ ({}));
  const release = () => {
    held.current.mask?.detach(held.current.mesh);
    held.current = {};
  };
  const attach = () => {
    const { mask, mesh } = find();
    if (mask === held.current.mask && mesh === held.current.mesh) return;
    release();
    if (mask && mesh?.material === mask.material) held.current = { mask: mask.attach(mesh), mesh };
  };
  useLayoutEffect(attach);
  useLayoutEffect(() => release, []);
  return attach;
}

/**
 * Move a fold with the clock, unless the time is given.
 *
 * @param {{ fold?: unknown, time?: number }} props
 * @param {{ readonly current: { time: number } | null }} target
 */
export function useTime({ fold, time }, target) {
  useFrame(({ clock }) => {
    if (fold && time === undefined && target.current) target.current.time = clock.elapsedTime;
  });
}
