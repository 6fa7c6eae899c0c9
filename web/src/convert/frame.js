// A frame for a document whose styles are to be computed: nothing in it runs, and nothing is fetched.
import { ownSize } from './viewport.js';

const POLICY = "default-src 'none'; style-src 'unsafe-inline'";
const STILL = '*{animation:none!important;transition:none!important}';

/** @param {Element} root becomes the root of the frame's document @returns {HTMLIFrameElement} */
export function openFrame(root) {
  const [width, height] = ownSize((name) => root.getAttribute(name));
  const frame = document.createElement('iframe');
  frame.setAttribute('sandbox', 'allow-same-origin');
  frame.setAttribute('aria-hidden', 'true');
  frame.tabIndex = -1;
  const { style } = frame;
  style.cssText = 'position:fixed;left:-99999px;top:0;border:0;visibility:hidden;color-scheme:light';
  [style.width, style.height] = [width, height].map((side) => `${Math.min(Math.max(side, 1), 16384)}px`);
  document.documentElement.append(frame);
  const inner = /** @type {Document} */ (frame.contentDocument);
  inner.open();
  inner.write(`<!doctype html><meta http-equiv="Content-Security-Policy" content="${POLICY}">`);
  inner.close();
  inner.replaceChild(inner.adoptNode(root), inner.documentElement);
  const sheet = new /** @type {Window & typeof globalThis} */ (inner.defaultView).CSSStyleSheet();
  sheet.replaceSync(STILL);
  inner.adoptedStyleSheets = [sheet];
  return frame;
}

/** @param {HTMLIFrameElement} frame */
export const closeFrame = (frame) => frame.remove();
