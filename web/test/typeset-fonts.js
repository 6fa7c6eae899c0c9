// Fonts of the tests of web/src/typeset, and requests of them.
import { readFileSync } from 'node:fs';
import { Typesetter } from '../src/typeset/typesetter.js';

/** @param {string} name */
export function fontFile(name) {
  const family = name.startsWith('reem') ? 'reem-kufi-fun' : 'pacifico';
  return new Uint8Array(readFileSync(new URL(`../node_modules/@fontsource/${family}/files/${name}`, import.meta.url))).buffer;
}

export const PACIFICO = 'pacifico-latin-400-normal.woff', CYRILLIC = 'pacifico-cyrillic-400-normal.woff2', ARABIC = 'reem-kufi-fun-arabic-400-normal.woff2';

/** A typesetter with fonts 0, 1, 2: Pacifico in Latin, in Cyrillic, and Reem Kufi Fun in Arabic, with colours. */
export function typesetter() {
  const made = new Typesetter();
  [PACIFICO, CYRILLIC, ARABIC].forEach((name, id) => made.addFont(id, fontFile(name)));
  return made;
}

/**
 * The result of a text.
 *
 * @param {Typesetter} setter
 * @param {string} text
 * @param {object} [style]
 * @returns {Promise<any>}
 */
export async function setText(setter, text, style = {}) {
  const answer = await setter.answer({ id: 1, texts: [{ text, fonts: [0, 1, 2], ...style }] });
  return { ...answer.reply.results[0], added: answer.reply.added };
}
