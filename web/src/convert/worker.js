// The worker of conversions: the first message says where the kernels are, each further one is a drawing to convert.
import { VextureError, line } from '../errors.js';
import { Conversion } from './conversion.js';

let conversion = new Conversion();

const scope = /** @type {Worker} */ (/** @type {unknown} */ (globalThis)); // what it has of a worker's side is the same

scope.onmessage = async (/** @type {MessageEvent} */ { data }) => {
  if (!('drawing' in data)) {
    conversion = new Conversion(data.kernels);
    return;
  }
  try {
    const converted = await conversion.convert(data.drawing, data.options);
    scope.postMessage({ converted }, [converted.texels.buffer]);
  } catch (error) {
    const { message, field } = error instanceof VextureError ? error : { message: line(error), field: 'source' };
    scope.postMessage({ message, field });
  }
};
