/** What shows drawings in notebooks: one module for all widgets of a page, and the script of a saved widget's page. */
import { followSaved } from './saved.js';
import { Stage } from './stage.js';

/**
 * Show a widget in an element.
 *
 * @param {{ model: import('./widget.js').Model, el: HTMLElement, source: () => Promise<import('./widget.js').Shared> | null }} widget
 * @returns {() => void} takes it away again
 */
export function attach({ model, el, source }) {
  const stage = new Stage(model, source);
  el.append(stage.element);
  return () => stage.dispose();
}

followSaved(attach);
