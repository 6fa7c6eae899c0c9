/** What a stage has room for beside its picture. */

/** Pixels of width up to which a stage is narrow. */
const NARROW = 480;

/** Pixels of height below which there is no legend, and below which there is no time. */
const LOW = 80;
const FLAT = 48;

/**
 * Follow the size of a stage, which may be far less than that of the page.
 *
 * @param {HTMLElement} stage
 * @param {(isWide: boolean) => void} changed called at first, and when it has become wide or narrow
 * @param {AbortSignal} ended
 */
export function followRoom(stage, changed, ended) {
  /** @type {boolean | null} */
  let wasWide = null;
  const sizes = new ResizeObserver(() => {
    const { clientWidth: width, clientHeight: height } = stage;
    if (width === 0) return; // it is hidden
    stage.classList.toggle('low', height < LOW);
    stage.classList.toggle('flat', height < FLAT);
    const isWide = width > NARROW;
    if (isWide !== wasWide) changed(wasWide = isWide);
  });
  sizes.observe(stage);
  ended.addEventListener('abort', () => sizes.disconnect());
}
