// What a canvas says, for those who do not see it: a hidden element with the words of texts, which screen readers read.

/** A text as a hidden element of the page; none outside of pages. */
export class AriaMirror {
  /** @type {HTMLElement | null} */
  #element = null;

  /**
   * Say a text.
   *
   * @param {string} text
   * @param {'off' | 'polite' | 'assertive'} live when a screen reader reads a change: never by itself, after what it reads
   *   now, or at once
   */
  say(text, live) {
    if (live === 'off' || typeof document === 'undefined') {
      this.dispose();
      return;
    }
    this.#element ??= hiddenElement();
    this.#element.setAttribute('aria-live', live);
    if (this.#element.textContent !== text) this.#element.textContent = text;
  }

  dispose() {
    this.#element?.remove();
    this.#element = null;
  }
}

/** Hidden from the eye alone: what is not displayed is not read. */
function hiddenElement() {
  const element = document.createElement('div');
  Object.assign(element.style, {
    position: 'absolute', width: '1px', height: '1px', overflow: 'hidden', clipPath: 'inset(50%)', whiteSpace: 'pre-wrap',
  });
  document.body.append(element);
  return element;
}
