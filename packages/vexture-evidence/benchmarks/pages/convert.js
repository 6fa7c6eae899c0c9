// Conversions of drawings in a page, by the package's own worker and kernels.

import { convert, convertData, writePacked } from '../../../../web/src/convert/index.js';

/** Bytes of a base64 text. */
const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

/** The file of the texture of a drawing, in base64, and its notes; or the one error. */
window.textureOf = async (content, name) => {
    try {
        const data = await convertData(bytes(content), { name });
        const file = await writePacked(data);
        return { file: btoa(Array.from(file, (byte) => String.fromCharCode(byte)).join('')), notes: data.notes };
    } catch (error) {
        return { error: `${error.name}: ${error.message}` };
    }
};

/** Milliseconds from the text of a drawing to its texture, again and again. */
window.timesOf = async (text, repeat) => {
    const times = [];
    for (let turn = 0; turn < repeat; turn++) {
        const start = performance.now();
        await convert(text);
        times.push(performance.now() - start);
    }
    return times;
};
