// Reads SVG for tests; outlines of strokes come from the server.
import { svgDrawing } from '../../../web/src/convert/svg.js';

function strokeOutline(cubics, closed, style) {
  const request = new XMLHttpRequest();
  request.open('POST', '/stroke', false);
  request.send(JSON.stringify({ cubics: [...cubics], closed, style }));
  return JSON.parse(request.responseText).map((contour) => Float64Array.from(contour));
}

/** A paint without arrays of bytes. */
function plainPaint({ picture, ...paint }) {
  const pixels = picture && { ...picture.pixels, rgba: [...picture.pixels.rgba] };
  return { ...paint, picture: picture ? { ...picture, pixels } : null };
}

const plain = (path) => ({ ...path, contours: path.contours.map((contour) => [...contour]), paint: plainPaint(path.paint) });

window.readText = async (text, name) => {
  const start = performance.now();
  try {
    const drawing = await svgDrawing(text, { name, strokeOutline });
    return { ...drawing, paths: drawing.paths.map(plain), ms: performance.now() - start };
  } catch (error) {
    return { error: `${error.name}: ${error.message}`, stack: error.stack, ms: performance.now() - start };
  }
};

window.readSource = async (source, options = {}) => {
  const drawing = await svgDrawing(source, { strokeOutline, ...options });
  return { ...drawing, paths: drawing.paths.map(plain) };
};
