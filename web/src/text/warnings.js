// What a text lacks, said once in the console.

/** Characters that were named already. @type {Set<number>} */
const NAMED = new Set();

/** Notes that were given already. @type {Set<string>} */
const NOTED = new Set();

/** @param {{ missing: number[], notes: string[] }} layout */
export function warnOf({ missing, notes }) {
  warnOfCharacters(missing);
  for (const note of notes) if (!NOTED.has(note)) console.warn(`vexture: ${note}`);
  notes.forEach((note) => NOTED.add(note));
}

/** Say an error, once. @param {string} message */
export function reportOnce(message) {
  if (NOTED.has(message)) return;
  NOTED.add(message);
  console.error(`vexture: ${message}`);
}

/** Name characters once that no font has. @param {number[]} missing code points */
function warnOfCharacters(missing) {
  const fresh = missing.filter((code) => !NAMED.has(code));
  if (!fresh.length) return;
  fresh.forEach((code) => NAMED.add(code));
  const shown = fresh.slice(0, 10).map((code) => `${String.fromCodePoint(code)} (U+${code.toString(16).toUpperCase().padStart(4, '0')})`);
  console.warn(`vexture: no font of the text has ${shown.join(', ')}${fresh.length > 10 ? ` and ${fresh.length - 10} more` : ''}; add one to \`font\``);
}
