// A text of `vexture/text` as a component of React Three Fiber.
import { useThree } from '@react-three/fiber';
import {
  Children, createElement, forwardRef, useEffect, useImperativeHandle, useLayoutEffect, useMemo, useReducer, useRef,
} from 'react';
import { Glyphs } from '../text/index.js';
import { weightOf } from '../text/faces.js';
import { DEFAULTS, requestOf } from '../text/text-options.js';
import { FollowingText } from './following-text.js';
import { useChanges } from './hooks.js';

/** @import { Text } from '../text/index.js' */
/** @import { TextOptions } from '../text/text-options.js' */

/**
 * @typedef {object} TextElementProps Props of a text besides its options.
 * @property {import('react').ReactNode} [children] strings and numbers are the text, if there is no `text`; an element of a
 *   material is the text's material; others are in the text's group
 * @property {(text: Text) => void} [onSync] called when the text is shown as its props say
 * @property {(error: Error) => void} [onError] called when it cannot be
 * @property {boolean} [suspend] whether the nearest `Suspense` shows its fallback until fonts and glyphs of the first text are
 *   there; false by default
 * @property {Glyphs} [glyphs] the worker and the texture, by default those of the page
 * @property {import('react').Ref<Text>} [ref] the text
 *
 * @typedef {Partial<TextOptions> & TextElementProps
 *   & Omit<import('@react-three/fiber').ThreeElements['mesh'], 'ref' | 'children' | 'onError' | 'args'>} VectorTextProps
 *   the options of `Text`, props of the component, and those of any mesh, such as `position` and `onClick`
 */

/** What troika's texts can do and these cannot, and what does instead. */
const ELSEWHERE = Object.freeze({
  outlineBlur: 'an outline has no blur; show it with outlineOpacity',
  styleRanges: 'colours are in colorRanges; take another text for another font or size',
  orientation: 'set rotation',
});

/** Props of troika's texts that change nothing here. */
const NEEDLESS = Object.freeze(['sdfGlyphSize', 'gpuAccelerateSDF', 'glyphGeometryDetail', 'unicodeFontsUrl', 'characters', 'debugSDF']);

/** Props that were named. @type {Set<string>} */
const NAMED = new Set();

/** @param {Record<string, any>} props */
function divided({ children, text, onSync, onError, suspend, glyphs, ...props }) {
  /** @type {any[]} */
  const words = [];
  /** @type {any[]} */
  const nodes = [];
  for (const child of Children.toArray(children)) (typeof child === 'object' ? nodes : words).push(child);
  /** @type {Map<string, any>} */
  const options = new Map([['anchorX', 'center'], ['anchorY', 'middle'], ['text', String(text ?? words.join(''))]]);
  /** @type {Record<string, any>} */
  const others = {};
  for (const [name, value] of Object.entries(props)) {
    if (value === undefined || NEEDLESS.includes(name)) continue;
    if (name in DEFAULTS) options.set(name, value);
    else if (name in ELSEWHERE) warnOnce(name);
    else others[name] = value;
  }
  return { nodes, options, others };
}

/** @param {string} name */
function warnOnce(name) {
  if (NAMED.has(name)) return;
  NAMED.add(name);
  console.warn(`vexture: VectorText has no prop ${name}: ${ELSEWHERE[/** @type {keyof typeof ELSEWHERE} */ (name)]}`);
}

/** @typedef {{ promise: Promise<void>, isDone: boolean, error: unknown }} Wait */

/** What components wait for: it is elsewhere, as a component that suspends has no memory. @type {WeakMap<Glyphs, Map<string, Wait>>} */
const WAITS = new WeakMap();

/** Fonts that are contents, by which they are known again. @type {unknown[]} */
const CONTENTS = [];

/** @param {string} _name @param {unknown} value */
function named(_name, value) {
  if (!(value instanceof ArrayBuffer) && !ArrayBuffer.isView(value)) return value;
  if (!CONTENTS.includes(value)) CONTENTS.push(value);
  return CONTENTS.indexOf(value);
}

/**
 * Suspend until the glyphs of a text are there.
 *
 * @param {Glyphs} glyphs
 * @param {TextOptions} options
 */
function wait(glyphs, options) {
  const waits = WAITS.get(glyphs) ?? new Map();
  WAITS.set(glyphs, waits);
  const { font, fontWeight, fontStyle, text } = options;
  if (!text || (font && typeof font === 'object' && 'isAtlasFont' in font)) return; // a baked font is there
  const key = JSON.stringify([font, fontWeight, fontStyle, options.fontVariations, text], named);
  if (!waits.has(key)) {
    const fresh = /** @type {Wait} */ ({ isDone: false, error: null });
    const found = glyphs.typeset(requestOf(options), { font, weight: weightOf(fontWeight), isItalic: fontStyle === 'italic' });
    fresh.promise = found.then(() => {}, (error) => void (fresh.error = error)).finally(() => (fresh.isDone = true));
    waits.set(key, fresh);
  }
  const { isDone, error, promise } = waits.get(key);
  if (error) waits.delete(key); // whoever tries again does
  if (error) throw error;
  if (!isDone) throw promise;
}

/**
 * A text that lasts as long as the component does, through React's strict mode, too.
 *
 * @param {Glyphs} glyphs
 */
function useText(glyphs) {
  const [age, renew] = useReducer((/** @type {number} */ count) => count + 1, 0);
  const text = useMemo(() => new (/** @type {any} */ (FollowingText))({ glyphs }), [glyphs, age]);
  const present = useRef(/** @type {unknown} */ (null));
  useEffect(() => {
    present.current = text;
    if (text.isDisposed) renew();
    return () => {
      present.current = null;
      queueMicrotask(() => {
        if (present.current !== text) text.dispose();
      });
    };
  }, [text]);
  return text;
}

/**
 * A text that may change in every frame, exact at every size. All props can change at any time. Its origin is its middle,
 * unless `anchorX` and `anchorY` say otherwise.
 *
 * @type {(props: VectorTextProps) => import('react').ReactNode}
 */
export const VectorText = /** @type {any} */ (forwardRef((/** @type {any} */ props, ref) => {
  const { onSync, onError, suspend = false, glyphs = Glyphs.shared } = props;
  const { nodes, options, others } = divided(props);
  const isFirst = useRef(true);
  if (suspend && isFirst.current) wait(glyphs, { ...DEFAULTS, ...Object.fromEntries(options) });
  const text = useText(glyphs);
  const change = useChanges();
  const invalidate = useThree((state) => state.invalidate);
  const told = useRef(/** @type {any} */ ({}));
  useLayoutEffect(() => {
    told.current = { onSync, onError };
    isFirst.current = false;
  });
  useLayoutEffect(() => {
    const shown = () => {
      invalidate();
      told.current.onSync?.(text);
    };
    const failed = () => told.current.onError?.(text.error);
    const target = /** @type {any} */ (text);
    target.addEventListener('synccomplete', shown);
    target.addEventListener('error', failed);
    return () => {
      target.removeEventListener('synccomplete', shown);
      target.removeEventListener('error', failed);
    };
  }, [text]);
  useLayoutEffect(() => {
    change(text, options, undefined, (changes) => Object.assign(text, Object.fromEntries(changes)));
  });
  useImperativeHandle(ref, () => text, [text]);
  return createElement('primitive', { ...others, object: text }, ...nodes);
}));
