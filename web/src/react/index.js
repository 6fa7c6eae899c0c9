/**
 * Components and hooks for React Three Fiber.
 *
 * @module
 */

// Nothing here is JSX, so that it needs no compiler.
import { extend, useLoader } from '@react-three/fiber';
import { createElement, forwardRef, useImperativeHandle, useLayoutEffect, useMemo, useRef } from 'react';
import { VextureError } from '../errors.js';
import { FoldLoader } from '../fold-loader.js';
import { NAMES } from '../mask-options.js';
import { applyVectorMask } from '../vector-mask.js';
import { VectorMaterial as Material } from '../vector-material.js';
import { VectorTextureLoader } from '../vector-texture-loader.js';
import { meshOf, useChanges, useColors, useMesh, useTime } from './hooks.js';

export { VectorText } from './text.js';

/** @typedef {import('./text.js').TextElementProps} TextElementProps */

/** @import { VectorMask as Mask } from '../vector-mask.js' */
/** @import { AnyVectorTexture, VectorTexture } from '../vector-texture.js' */

/**
 * @typedef {object} SourceProps Props of both components besides their options.
 * @property {string} [src] address of a texture, which is loaded while the nearest `Suspense` shows its fallback
 * @property {import('../paints.js').PaintList | null} [colors] other colours of elements (`vexture convert --restyle`), on
 *   a copy of the texture: what else shows the texture keeps its colours. An element that is not named has its own
 *
 * @typedef {object} MaterialElementProps Props that React handles for a material.
 * @property {import('react').Key | null} [key] React's key
 * @property {import('react').ReactNode} [children] children of the material
 * @property {string | ((parent: any, material: Material) => () => void)} [attach] property of the parent that holds it, by
 *   default `material`
 * @property {null} [dispose] null: the material is kept when it is unmounted
 * @property {import('react').Ref<Material>} [ref] the material
 *
 * @typedef {import('../vector-material.js').VectorMaterialParameters & SourceProps & MaterialElementProps}
 *   VectorMaterialProps the options of the class of that name, and the props of the component; `toneMapped` is false by default, so that colours are the drawing's
 *
 * @typedef {object} MaskElementProps Props of a mask besides its options.
 * @property {AnyVectorTexture | null} [texture] the texture with the shape; null: no mask
 * @property {import('react').Key | null} [key] React's key
 * @property {import('react').Ref<Mask>} [ref] the mask
 *
 * @typedef {import('../mask-options.js').MaskOptions & SourceProps & MaskElementProps} VectorMaskProps the options of
 *   `applyVectorMask`, and the props of the component
 *
 * @typedef {import('./text.js').VectorTextProps} VectorTextProps the options of `Text`, props of the component, and those of any
 *   mesh, such as `position` and `onClick`
 */

extend({ VextureMaterial: Material });

/**
 * Load one or several textures while the nearest `Suspense` shows its fallback. All components that request an address
 * share its texture.
 *
 * @template {string | readonly string[]} T
 * @param {T} url
 * @param {(loader: VectorTextureLoader) => void} [prepare] sets the loader's path, headers or credentials
 * @returns {T extends string ? VectorTexture : VectorTexture[]}
 */
export function useVectorTexture(url, prepare) {
  return /** @type {any} */ (useLoader(VectorTextureLoader, /** @type {any} */ (url), prepare));
}

/** Load before a component requests it. @param {string | string[]} url */
useVectorTexture.preload = (url) => useLoader.preload(VectorTextureLoader, url);
/** Forget, so that the next request loads again. @param {string | string[]} url */
useVectorTexture.clear = (url) => useLoader.clear(VectorTextureLoader, url);

/**
 * Load a fold while the nearest `Suspense` shows its fallback.
 *
 * @param {string} url
 * @returns {import('../fold-texture.js').FoldTexture}
 */
export function useFold(url) {
  return useLoader(FoldLoader, url);
}

/**
 * A component that loads `src`, if it has one, and then is another with a texture.
 *
 * @param {(props: any, ref: any) => any} render
 * @returns {any}
 */
function sourced(render) {
  const Shown = forwardRef(render);
  const Loaded = forwardRef((/** @type {any} */ { src, ...props }, ref) =>
    createElement(Shown, { ...props, texture: useVectorTexture(src), ref }),
  );
  return forwardRef((/** @type {any} */ { src, ...props }, ref) =>
    src === undefined ? createElement(Shown, { ...props, ref }) : createElement(Loaded, { ...props, src, ref }),
  );
}

/**
 * The options among a component's props, and the other props.
 *
 * @param {Record<string, any>} props
 * @param {(name: string) => boolean} isOption
 */
function divided(props, isOption) {
  const given = Object.entries(props).filter(([, value]) => value !== undefined);
  return {
    options: new Map(given.filter(([name]) => isOption(name))),
    others: Object.fromEntries(given.filter(([name]) => !isOption(name))),
  };
}

/** Of these the material has its own. @param {string} name */
const isMaterialOption = (name) => NAMES.includes(name) && name !== 'color' && name !== 'map';

/**
 * An unlit material that shows a drawing in its own colours, or a shape in `color`. Rays and light pass through its mesh
 * outside the shape. All props can change at any time.
 *
 * @type {(props: VectorMaterialProps) => import('react').ReactNode}
 */
export const VectorMaterial = sourced(({ texture = null, colors, ...props }, ref) => {
  const material = useRef(/** @type {Material | null} */ (null));
  const change = useChanges();
  const { options, others } = divided(props, isMaterialOption);
  if (props.color !== undefined && !options.has('mode')) options.set('mode', 'alpha');
  const shown = useColors(texture, colors, props.root);
  useLayoutEffect(() => {
    const { current } = material;
    const apply = (/** @type {Map<string, any>} */ changes) => current?.setValues(Object.fromEntries(changes));
    change(current, new Map([...options, ['texture', shown]]), undefined, apply);
  });
  useMesh(() => ({ mask: material.current?.mask, mesh: meshOf(material.current) }));
  useTime(props, material);
  useImperativeHandle(ref, () => material.current);
  return createElement('vextureMaterial', { toneMapped: false, ...others, ref: material });
});

/** The material that a mask is for. @param {any} parent what the mask is in @returns {import('three').Material} */
function materialOf(parent) {
  const material = parent?.isMaterial ? parent : parent?.material;
  if (material?.isMaterial) return material;
  throw new VextureError(`VectorMask is in ${parent?.type ?? 'nothing'}; put it into one material, or a mesh with one`, 'parent');
}

/** Tell the object that stands for a mask what it is in. @param {any} parent @param {any} place */
function keep(parent, place) {
  place.parent = parent;
  place.follow?.(); // the parent has become another object
  place.attach?.();
  return () => (place.parent = null);
}

/**
 * Masks its parent material, or the material of its parent mesh, with a shape. Rays and light pass through the mesh
 * outside the shape. All props can change at any time.
 *
 * @type {(props: VectorMaskProps) => import('react').ReactNode}
 */
export const VectorMask = sourced(({ texture = null, colors, ...props }, ref) => {
  const place = useMemo(() => /** @type {any} */ ({}), []);
  const mask = useRef(/** @type {Mask | null} */ (null));
  const change = useChanges();
  const { options } = divided(props, () => true);
  const shown = useColors(texture, colors, props.root);
  const remove = () => {
    mask.current?.remove();
    mask.current = null;
  };
  useLayoutEffect(() => {
    place.follow = () => {
      const material = shown && materialOf(place.parent);
      if (mask.current?.material !== material) remove();
      if (!material) return;
      mask.current ??= applyVectorMask(material, shown, Object.fromEntries(options));
      const { current } = mask;
      const values = new Map([...options, ['texture', shown]]);
      change(current, values, undefined, (/** @type {any} */ changes) => current.set(Object.fromEntries(changes)));
    };
    place.follow();
  });
  place.attach = useMesh(() => ({ mask: mask.current, mesh: place.parent?.isMaterial ? meshOf(place.parent) : place.parent }));
  useLayoutEffect(() => remove, []);
  useTime(props, mask);
  useImperativeHandle(ref, () => mask.current);
  return createElement('primitive', { object: place, attach: keep });
});
