/**
 * Read a pair of thesis textures and check them. What does so comes when it is first needed: bundlers keep it, its
 * decoder of PNG and its shader in a chunk of their own, which pages with packed textures never load.
 *
 * @param {ArrayBuffer | Uint8Array} quadsPng contents of `NAME.quads.png`
 * @param {ArrayBuffer | Uint8Array} curvesPng contents of `NAME.curves.png`
 * @param {string} [name]
 * @returns {Promise<import('./data.js').ThesisData>}
 * @throws {import('./errors.js').VextureError} if a file is damaged, or the two do not belong together
 */
export async function readThesis(quadsPng, curvesPng, name) {
  const { checkedThesis } = await import('./thesis.js');
  return checkedThesis(quadsPng, curvesPng, name);
}
