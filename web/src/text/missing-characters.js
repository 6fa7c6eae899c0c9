// Characters that no font of a text has.

/** Characters that were named already. @type {Set<number>} */
const NAMED = new Set();

/** Name characters once that no font has. @param {number[]} missing code points */
export function warnOfCharacters(missing) {
  const fresh = missing.filter((code) => !NAMED.has(code));
  if (!fresh.length) return;
  fresh.forEach((code) => NAMED.add(code));
  const shown = fresh.slice(0, 10).map((code) => `${String.fromCodePoint(code)} (U+${code.toString(16).toUpperCase().padStart(4, '0')})`);
  console.warn(`vexture: no font of the text has ${shown.join(', ')}${fresh.length > 10 ? ` and ${fresh.length - 10} more` : ''}; add one to \`font\``);
}
