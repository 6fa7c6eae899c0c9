/** Elements in one call. */

/**
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, string | number | boolean | null | ((event: any) => void)>} [attributes] functions listen: onclick
 * @param {(Node | string)[]} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, '');
    else if (value !== false && value !== null) made.setAttribute(name, String(value));
  }
  made.append(...children);
  return made;
}

/**
 * A labelled select element.
 *
 * @param {string} label
 * @param {Iterable<readonly [string, string]>} choices values and labels
 * @param {(value: string) => void} chosen
 */
export function select(label, choices, chosen) {
  const list = element('select', { onchange: () => chosen(list.value) });
  for (const [value, text] of choices) list.append(element('option', { value }, text));
  const row = element('label', { class: 'row' }, element('span', {}, label), list);
  return { row, list };
}

/**
 * A titled section of the panel.
 *
 * @param {string} title
 * @param {(Node | string)[]} children
 */
export function section(title, ...children) {
  return element('section', { 'aria-label': title }, element('h2', {}, title), ...children);
}
