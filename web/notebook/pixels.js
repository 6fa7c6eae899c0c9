/** How many pixels of the screen a canvas has: with as many of its own its picture is crisp. */

/** Pixels by which a canvas that lies between two of the screen's differs from its size times their ratio. */
const BETWEEN = 1;

/** @param {number} wanted @param {number | undefined} counted by the browser */
const whole = (wanted, counted) =>
  (counted !== undefined && Math.abs(counted - wanted) <= BETWEEN ? counted : Math.round(wanted));

/**
 * Give a canvas the screen's pixels, now and whenever their number changes: the element's size, the page's zoom, the screen.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {() => void} changed called when it has another number, and so is blank
 * @param {AbortSignal} ended
 */
export function followPixels(canvas, changed, ended) {
  const fit = (/** @type {ResizeObserverSize | undefined} */ counted) => {
    const { clientWidth, clientHeight } = canvas;
    const width = whole(clientWidth * devicePixelRatio, counted?.inlineSize);
    const height = whole(clientHeight * devicePixelRatio, counted?.blockSize);
    if (width === canvas.width && height === canvas.height) return;
    Object.assign(canvas, { width, height });
    changed();
  };
  const sizes = new ResizeObserver(([{ devicePixelContentBoxSize: counted }]) => fit(counted?.[0]));
  sizes.observe(canvas);
  ended.addEventListener('abort', () => sizes.disconnect());
  const followRatio = () => {
    if (ended.aborted) return;
    matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener('change', () => {
      sizes.unobserve(canvas);
      sizes.observe(canvas); // counts again
      followRatio();
    }, { once: true, signal: ended });
  };
  followRatio();
}
