// A frame for a document whose styles are to be computed: nothing in it runs, and nothing is fetched.
import { withTrust } from './trusted.js';
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
  try {
    fill(/** @type {Document} */ (frame.contentDocument), root);
  } catch (error) {
    frame.remove();
    throw error;
  }
  return frame;
}

/** @param {Document} inner @param {Element} root */
function fill(inner, root) {
  inner.open();
  withTrust(`<!doctype html><meta http-equiv="Content-Security-Policy" content="${POLICY}">`, (trusted) => inner.write(trusted));
  inner.close();
  inner.replaceChild(inner.adoptNode(root), inner.documentElement);
  const { CSSStyleSheet } = /** @type {Window & typeof globalThis} */ (inner.defaultView);
  const texts = [STILL, ...forbiddenStyles(root)];
  inner.adoptedStyleSheets = texts.map((text) => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(text);
    return sheet;
  });
}

/**
 * Apply styles that the page's policy forbids in markup: scripts may still set them.
 *
 * @param {Element} root
 * @returns {string[]} texts of style sheets
 */
function forbiddenStyles(root) {
  for (const element of [root, ...root.querySelectorAll('[style]')]) {
    const text = element.getAttribute('style');
    const { style } = /** @type {SVGElement} */ (element);
    if (text && style?.length === 0) style.cssText = text;
  }
  const sheets = [...root.getElementsByTagName('style')].filter((one) => !one.sheet && one.textContent?.trim());
  return sheets.map(({ media, textContent }) => (media ? `@media ${media} {${textContent}}` : textContent ?? ''));
}

/** @param {HTMLIFrameElement} frame */
export const closeFrame = (frame) => frame.remove();
