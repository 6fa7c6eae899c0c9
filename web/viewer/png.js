/**
 * PNG with straight opacity, row by row. A canvas multiplies colours by their opacity and divides them again, in 8 bits,
 * which changes them where little is covered. Plain data.
 */

const SIGNATURE = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
const RGBA = [8, 6, 0, 0, 0]; // bits of a component; colours with opacity; deflated, rows one by one, not interlaced
const SRGB = [0]; // perceptual

const CRCS = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  return crc;
});

/** @param {number} value @returns {number[]} big-endian */
const word = (value) => [value >>> 24, (value >>> 16) & 255, (value >>> 8) & 255, value & 255];

/** @param {string} kind @param {ArrayLike<number>} data */
function chunk(kind, data) {
  const bytes = new Uint8Array(data.length + 12);
  bytes.set(word(data.length));
  bytes.set([...kind].map((letter) => letter.charCodeAt(0)), 4);
  bytes.set(data, 8);
  let crc = ~0;
  for (const byte of bytes.subarray(4, -4)) crc = CRCS[(crc ^ byte) & 255] ^ (crc >>> 8);
  bytes.set(word(~crc), data.length + 8);
  return bytes;
}

/**
 * @param {number} width
 * @param {number} height
 * @param {AsyncIterable<Uint8Array>} bands of whole rows of straight RGBA, the topmost first
 * @returns {Promise<Blob>}
 */
export async function pngOf(width, height, bands) {
  if (!('CompressionStream' in globalThis)) throw new Error('this browser cannot compress it; try a newer one');
  const deflate = new CompressionStream('deflate');
  const writer = deflate.writable.getWriter();
  const deflated = new Response(deflate.readable).arrayBuffer();
  try {
    for await (const band of bands) {
      const rows = band.length / (4 * width);
      const filtered = new Uint8Array(band.length + rows); // each row after a 0: as it is
      for (let row = 0; row < rows; row++) {
        filtered.set(band.subarray(4 * width * row, 4 * width * (row + 1)), (4 * width + 1) * row + 1);
      }
      await writer.write(filtered);
    }
    await writer.close();
  } catch (error) {
    deflated.catch(() => {});
    await writer.abort(error).catch(() => {});
    throw error;
  }
  const parts = [
    Uint8Array.from(SIGNATURE), chunk('IHDR', [...word(width), ...word(height), ...RGBA]), chunk('sRGB', SRGB),
    chunk('IDAT', new Uint8Array(await deflated)), chunk('IEND', []),
  ];
  return new Blob(parts, { type: 'image/png' });
}
