// Texts as runs of one font, script and direction.
import { VextureError } from '../errors.js';
import { graphemeEnds } from './breaks.js';
import { bidi } from './libraries.js';

/** @import { TypeFont } from './font.js' */
/** @import { Loadable } from './libraries.js' */

/**
 * @typedef {object} Run
 * @property {TypeFont} font
 * @property {number} start UTF-16 index
 * @property {number} end
 * @property {number} level of embedding: odd from right to left
 * @property {number} script
 * @property {boolean} isUpright
 */

/** Scripts by their names in Unicode; a run has one, from which HarfBuzz chooses the rules. */
const SCRIPTS = `
  Latin Greek Cyrillic Han Hiragana Katakana Hangul Arabic Hebrew Devanagari Thai Bengali Tamil Telugu Gujarati
  Gurmukhi Kannada Malayalam Oriya Sinhala Lao Tibetan Myanmar Georgian Armenian Ethiopic Khmer Mongolian Syriac
  Thaana Nko Cherokee Bopomofo Yi Adlam Ahom Anatolian_Hieroglyphs Avestan Balinese Bamum Bassa_Vah Batak
  Bhaiksuki Brahmi Braille Buginese Buhid Canadian_Aboriginal Carian Caucasian_Albanian Chakma Cham Chorasmian
  Coptic Cuneiform Cypriot Cypro_Minoan Deseret Dives_Akuru Dogra Duployan Egyptian_Hieroglyphs Elbasan Elymaic
  Garay Glagolitic Gothic Grantha Gunjala_Gondi Gurung_Khema Hanifi_Rohingya Hanunoo Hatran Imperial_Aramaic
  Inscriptional_Pahlavi Inscriptional_Parthian Javanese Kaithi Kawi Kayah_Li Kharoshthi Khitan_Small_Script Khojki
  Khudawadi Kirat_Rai Lepcha Limbu Linear_A Linear_B Lisu Lycian Lydian Mahajani Makasar Mandaic Manichaean
  Marchen Masaram_Gondi Medefaidrin Meetei_Mayek Mende_Kikakui Meroitic_Cursive Meroitic_Hieroglyphs Miao Modi Mro
  Multani Nabataean Nag_Mundari Nandinagari Newa New_Tai_Lue Nushu Nyiakeng_Puachue_Hmong Ogham Ol_Chiki Ol_Onal
  Old_Hungarian Old_Italic Old_North_Arabian Old_Permic Old_Persian Old_Sogdian Old_South_Arabian Old_Turkic
  Old_Uyghur Osage Osmanya Pahawh_Hmong Palmyrene Pau_Cin_Hau Phags_Pa Phoenician Psalter_Pahlavi Rejang Runic
  Samaritan Saurashtra Sharada Shavian Siddham SignWriting Sogdian Sora_Sompeng Soyombo Sundanese Sunuwar
  Syloti_Nagri Tagalog Tagbanwa Tai_Le Tai_Tham Tai_Viet Takri Tangsa Tangut Tifinagh Tirhuta Todhri Toto
  Tulu_Tigalari Ugaritic Vai Vithkuqi Wancho Warang_Citi Yezidi Zanabazar_Square`
  .trim()
  .split(/\s+/);

const LATIN = 0, KANA = SCRIPTS.indexOf('Hiragana'), KATAKANA = SCRIPTS.indexOf('Katakana');

/** Scripts whose letters join, so that space between them would tear them. */
const CURSIVE = new Set(
  ['Arabic', 'Syriac', 'Mongolian', 'Nko', 'Adlam', 'Mandaic', 'Manichaean', 'Phags_Pa', 'Hanifi_Rohingya', 'Psalter_Pahlavi', 'Sogdian'].map(
    (name) => SCRIPTS.indexOf(name),
  ),
);

/** @param {number} script */
export const isCursive = (script) => CURSIVE.has(script);

/** A character that has no script of its own. */
const SHARED = -1;
const COMMON = /[\p{Script=Common}\p{Script=Inherited}]/u;

/** Expressions of the scripts that this browser knows. @type {(RegExp | null)[]} */
const expressions = [];
/** @type {Map<number, number>} */
const scripts = new Map();

/**
 * Number of a character's script; those of common characters is -1.
 *
 * @param {number} code
 */
function scriptOf(code) {
  if (code < 0x250) return (code | 32) >= 97 && (code | 32) <= 122 ? LATIN : code < 0xc0 ? SHARED : code === 0xd7 || code === 0xf7 ? SHARED : LATIN;
  let script = scripts.get(code);
  if (script === undefined) {
    const character = String.fromCodePoint(code);
    script = COMMON.test(character) ? SHARED : SCRIPTS.findIndex((name, place) => expression(name, place)?.test(character));
    if (script === KATAKANA) script = KANA;
    scripts.set(code, script);
  }
  return script;
}

/** @param {string} name @param {number} place */
function expression(name, place) {
  if (expressions[place] === undefined) {
    try {
      expressions[place] = new RegExp(`\\p{Script=${name}}`, 'u');
    } catch {
      expressions[place] = null; // a script that is newer than the browser
    }
  }
  return expressions[place];
}

/** Most isolates of a paragraph: the time of bidi-js grows with their square. */
const MOST_ISOLATES = 10_000;

const ISOLATE = /[\u2066-\u2068]/g;

/** Texts that have only one direction, from left to right. */
const LEFT_TO_RIGHT = /^[\0-\u058f\u0900-\u200d\u2010-\u2029\u2030-\u2065\u2070-\ud801\ud804-\ud839\ud83c-\udfff\ue000-\ufb1c\ufe00-\ufe6f\uff00-\uffff]*$/;

/** Classes of supplementary characters that bidi-js, which looks at UTF-16 units, does not see, as characters it does. */
/** @type {Record<string, string>} */
const STAND_INS = { R: '\u05d0', AL: '\u0628', AN: '\u0660', EN: '0', NSM: '\u0300', BN: '\u200d', ON: '!', ET: '#', ES: '+' };

/**
 * Levels of embedding of a paragraph's units (UAX 9, before rule L1 at the ends of lines).
 *
 * @param {string} text
 * @param {'auto' | 'ltr' | 'rtl'} direction
 * @param {Set<Loadable>} needed a library to load first is added
 * @returns {{ levels: Uint8Array | null, level: number }} `levels` is null if all are 0; `level` of the paragraph
 */
export function levelsOf(text, direction, needed) {
  if (direction !== 'rtl' && LEFT_TO_RIGHT.test(text)) return { levels: null, level: 0 };
  if (!bidi.isLoaded) {
    needed.add(bidi);
    return { levels: null, level: 0 };
  }
  const isolates = text.match(ISOLATE)?.length ?? 0;
  if (isolates > MOST_ISOLATES) {
    throw new VextureError(`\`text\` has ${isolates} isolates (U+2066 to U+2068) in a paragraph; the limit is ${MOST_ISOLATES}; divide it`, 'text');
  }
  const seen = text.replace(/[\u{10000}-\u{10ffff}]/gu, (character) => {
    return STAND_INS[bidi.content.getBidiCharTypeName(character)]?.repeat(2) ?? character;
  });
  const { levels, paragraphs } = bidi.content.getEmbeddingLevels(seen, direction === 'auto' ? undefined : direction);
  const level = paragraphs[0]?.level ?? (direction === 'rtl' ? 1 : 0);
  for (const { index, 0: separator } of text.matchAll(/[ \t]*\t/g)) levels.fill(level, index, index + separator.length); // rule L1
  return { levels, level };
}

/** Characters that show nothing, if a font lacks them. */
const INVISIBLE = /[\p{Default_Ignorable_Code_Point}\p{Cc}]/u;

const TAB = '\t';

const EMOJI = /^\p{Emoji}\ufe0f|^\p{Emoji_Presentation}(?!\ufe0e)|^\p{RI}{2}|^[#*0-9]\ufe0f?\u20e3/u;

/** Characters that stand upright in vertical text (UAX 50: U, Tu, Tr; the font turns those that it has turned). */
const UPRIGHT = rangesOf(`
  00a7 00a9 00ae 00b1 00bc-00be 00d7 00f7 02ea 02eb 1100-11ff 1401-167f 18b0-18ff 2016 2020 2021 2030 2031 203b
  203c 2042 2047-2049 2051 20dd-20e0 20e2-20e4 2100 2101 2103-2109 210f 2113 2114 2116 2117 211e-2123 2125 2127
  2129 212e 2135-213f 2145-214a 214c 214d 214f-2189 218c-218f 221e 2234 2235 2300-2307 230c-231f 2324-232b
  237d-239a 23be-23cd 23cf 23d1-23db 23e2-2422 2424-24ff 25a0-2619 2620-2767 2776-2793 2b12-2b2f 2b50-2b59 2b97
  2bb8-2bd1 2bd3-2beb 2bf0-2bff 2e50 2e51 2e80-a4cf a960-a97f ac00-d7ff e000-faff fe10-fe1f fe30-fe48 fe50-fe57
  fe5f-fe62 fe67-fe6f ff01-ff0c ff0e-ff1b ff1f-ff60 ffe0-ffe2 ffe4-ffe7 1b000-1b2ff 1d300-1d35f 1f000-1faff
  20000-3fffd`);

/** An expression of characters in ranges of hexadecimal numbers. @param {string} ranges */
function rangesOf(ranges) {
  const parts = ranges.trim().split(/\s+/);
  return new RegExp(`[${parts.map((part) => part.replace(/[0-9a-f]+/g, (code) => `\\u{${code}}`)).join('')}]`, 'u');
}

/** Texts that one run of the first font holds, if it has their characters. */
const PLAIN = /^[\x20-\x7e]*$/;

/**
 * Divide a paragraph into runs; a tab is one by itself, as its width depends on what is before it in its line.
 *
 * @param {string} text
 * @param {object} about
 * @param {TypeFont[]} about.fonts in order of preference
 * @param {Uint8Array | null} about.levels
 * @param {boolean} about.isVertical
 * @param {Set<Loadable>} about.needed fonts to load first are added
 * @param {Set<number>} about.missing characters that no font has are added
 * @returns {Run[]} in the order of the text
 */
export function runsOf(text, { fonts, levels, isVertical, needed, missing }) {
  /** @type {Run[]} */
  const runs = [];
  if (!text) return runs;
  const [first] = fonts;
  if (!levels && !isVertical && first.isLoaded && PLAIN.test(text)) {
    let place = 0;
    while (place < text.length && first.has(text.charCodeAt(place))) place++;
    if (place === text.length) return [{ font: first, start: 0, end: place, level: 0, script: LATIN, isUpright: false }];
  }
  /** @type {Run | null} */
  let run = null;
  let start = 0;
  /** @type {Map<string, Pick<Run, 'font' | 'script' | 'isUpright'>>} */
  const seen = new Map();
  for (const end of graphemeEnds(text)) {
    const cluster = text.slice(start, end);
    /** @type {Pick<Run, 'font' | 'script' | 'isUpright'> | undefined} */
    let about = seen.get(cluster);
    if (!about) {
      const script = scriptOf(/** @type {number} */ (cluster.codePointAt(0)));
      about = { font: fontOf(cluster, fonts, run, needed, missing), script, isUpright: isVertical && UPRIGHT.test(cluster) };
      if (cluster !== ' ') seen.set(cluster, about); // the font of a space is that of what is before it
    }
    /** @type {Pick<Run, 'font' | 'script' | 'isUpright'>} */
    const { font, script, isUpright } = about;
    const level = levels ? levels[start] : 0;
    const isTab = cluster === TAB || text[start - 1] === TAB;
    const isSame = run && !isTab && (script === SHARED || run.script === SHARED || run.script === script);
    if (run && isSame && run.font === font && run.level === level && run.isUpright === isUpright) {
      run.end = end;
      if (script !== SHARED) run.script = script;
    } else {
      run = { font, start, end, level, script, isUpright };
      runs.push(run);
    }
    start = end;
  }
  return runs;
}

/**
 * The font of a user-perceived character: the first that has all of it, or else its first character.
 *
 * @param {string} cluster
 * @param {TypeFont[]} fonts
 * @param {Run | null} before the run before it, whose font spaces take
 * @param {Set<Loadable>} needed
 * @param {Set<number>} missing
 * @returns {TypeFont}
 */
function fontOf(cluster, fonts, before, needed, missing) {
  const code = /** @type {number} */ (cluster.codePointAt(0));
  if (cluster === ' ' && before?.font.isLoaded && before.font.has(code)) return before.font;
  const isSingle = cluster.length === (code > 0xffff ? 2 : 1);
  const codes = isSingle ? [code] : Array.from(cluster, (one) => /** @type {number} */ (one.codePointAt(0)));
  const others = codes.slice(1).filter((one) => !isInvisible(one));
  const isEmoji = code > 0x22 && EMOJI.test(cluster);
  /** @type {TypeFont | null} */
  let partial = null, plain = null;
  for (const font of fonts) {
    if (!font.covers(code)) continue;
    if (!font.isLoaded) {
      if (!font.isPending) continue;
      needed.add(font);
      return font;
    }
    if (!font.has(code)) continue;
    if (!others.every((one) => font.has(one))) partial ??= font;
    else if (!isEmoji || font.hasColor) return font;
    else plain ??= font;
  }
  const found = plain ?? partial;
  if (found) return found;
  const fallback = primaryFont(fonts);
  if (!fallback.isLoaded) needed.add(fallback);
  else if (!isInvisible(code)) missing.add(code);
  return fallback;
}

/**
 * The font whose metrics count, and whose .notdef is shown: the first that is loaded, or may be.
 *
 * @param {TypeFont[]} fonts
 * @throws {VextureError} if all have failed
 */
export function primaryFont(fonts) {
  const found = fonts.find(({ isLoaded }) => isLoaded) ?? fonts.find(({ isPending }) => isPending);
  if (!found) throw fonts[0].error;
  return found;
}

/** @param {number} code */
const isInvisible = (code) => (code < 0x20 || code > 0x7e) && INVISIBLE.test(String.fromCodePoint(code));
