// Types alone, which JSDoc cannot say: three.js's intersections have the element of a drawing.
import type { Intersection } from 'three';
import type { FoundElement } from './element-at.js';

declare module 'three' {
  interface Intersection {
    /** On a mesh that is attached to a mask: the element of the drawing there, null without any. */
    element?: FoundElement | null;
  }
}

/** What a ray finds on an attached mesh: `element` is the element of the drawing there, null without any. */
export type MaskedIntersection = Intersection;
