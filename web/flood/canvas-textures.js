/** Textures drawn on a canvas: wood, layers of earth, sky, the box's shadow. */
import { CanvasTexture, MirroredRepeatWrapping, RepeatWrapping, SRGBColorSpace } from 'three';

/** Numbers 0..1 that are the same on each page. @param {number} seed @returns {() => number} */
export function chance(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/**
 * @param {number} width @param {number} height
 * @param {(context: CanvasRenderingContext2D) => void} draw
 */
function drawn(width, height, draw) {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [width, height];
  draw(/** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d')));
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

/** A plank: its grain runs along x. */
export function woodTexture() {
  const random = chance(7);
  const texture = drawn(1024, 128, (context) => {
    const { width, height } = context.canvas;
    context.fillStyle = '#b88a5a';
    context.fillRect(0, 0, width, height);
    for (let line = 0; line < 260; line++) {
      const [y, sway, turn] = [random() * height, 1 + random() * 3.5, random() * 6];
      const dark = random() < 0.6;
      context.strokeStyle = dark ? `rgb(96 58 26 / ${4 + random() * 20}%)` : `rgb(236 200 150 / ${4 + random() * 16}%)`;
      context.lineWidth = 0.5 + random() * 1.6;
      context.beginPath();
      for (let x = -8; x <= width + 8; x += 16) {
        const angle = (x * 2 * Math.PI) / width;
        context.lineTo(x, y + sway * (Math.sin(turn + angle) + 0.6 * Math.sin(3 * turn + 2 * angle)));
      }
      context.stroke();
    }
    for (const [x, y, size] of [[230, 38, 9], [760, 92, 7]]) {
      for (let ring = 5; ring >= 0; ring--) {
        context.strokeStyle = `rgb(84 48 20 / ${18 + 6 * (5 - ring)}%)`;
        context.lineWidth = 1.3;
        context.beginPath();
        context.ellipse(x, y, size * (0.5 + ring * 0.55), size * (0.22 + ring * 0.2), 0.05, 0, 2 * Math.PI);
        context.stroke();
      }
    }
  });
  texture.wrapS = RepeatWrapping;
  texture.wrapT = MirroredRepeatWrapping;
  return texture;
}

/** Layers below the surface: where each begins, and its colour. */
const EARTH = /** @type {const} */ ([
  [0, '#cdb585'], [0.1, '#bf9f6a'], [0.22, '#a8834f'], [0.42, '#8e6b42'], [0.62, '#75573a'], [0.82, '#5f4833'],
]);

/** What the cut sides of the ground show: y = 1 is its surface. */
export function earthTexture() {
  const random = chance(11);
  const texture = drawn(512, 256, (context) => {
    const { width, height } = context.canvas;
    for (const [top, color] of EARTH) {
      context.fillStyle = color;
      context.beginPath();
      context.moveTo(0, height);
      const turn = random() * 6;
      for (let x = 0; x <= width; x += 8) {
        const angle = (x * 2 * Math.PI) / width;
        const wave = 4 * Math.sin(turn + angle) + 2 * Math.sin(2 * turn + 3 * angle);
        context.lineTo(x, top * height + (top ? wave : -2));
      }
      context.lineTo(width, height);
      context.fill();
    }
    for (let grain = 0; grain < 5200; grain++) {
      const color = random() < 0.55 ? '60 40 20' : '250 230 190';
      context.fillStyle = `rgb(${color} / ${4 + random() * 15}%)`;
      const size = 0.6 + random() * random() * 2.6;
      context.fillRect(random() * width, random() * height, size * 1.6, size);
    }
  });
  texture.wrapS = RepeatWrapping;
  return texture;
}

/** Colours of the sky by degrees above the horizon; below it is haze. */
const SKY = /** @type {const} */ ([
  [90, '#3f7fc4'], [50, '#6aa3d8'], [22, '#9dc6e6'], [9, '#c9e0ee'], [2, '#e3edf1'], [0, '#e6eced'], [-3, '#e3e6e4'],
  [-30, '#d8d5cd'], [-90, '#cbc5b9'],
]);

/**
 * All around, east in the middle of the left half: as three.js wraps a sphere.
 *
 * @param {{x: number, y: number, z: number}} sun direction
 */
export function skyTexture(sun) {
  return drawn(1024, 512, (context) => {
    const { width, height } = context.canvas;
    const down = context.createLinearGradient(0, 0, 0, height);
    for (const [degrees, color] of SKY) down.addColorStop((90 - degrees) / 180, color);
    context.fillStyle = down;
    context.fillRect(0, 0, width, height);
    clouds(context);
    const x = ((Math.atan2(sun.z, -sun.x) / (2 * Math.PI) + 1) % 1) * width;
    const y = (0.5 - Math.asin(sun.y) / Math.PI) * height;
    for (const [size, strength] of [[150, 0.5], [46, 0.7], [9, 1]]) {
      for (const at of [x - width, x, x + width]) {
        const glow = context.createRadialGradient(at, y, 0, at, y, size);
        glow.addColorStop(0, `rgb(255 247 224 / ${strength * 100}%)`);
        glow.addColorStop(size < 10 ? 0.7 : 0.3, `rgb(255 247 224 / ${strength * (size < 10 ? 100 : 40)}%)`);
        glow.addColorStop(1, 'rgb(255 247 224 / 0%)');
        context.fillStyle = glow;
        context.fillRect(at - size, y - size, 2 * size, 2 * size);
      }
    }
  });
}

/** Thin ones, low over the horizon. @param {CanvasRenderingContext2D} context */
function clouds(context) {
  const random = chance(23);
  const { width, height } = context.canvas;
  for (let cloud = 0; cloud < 34; cloud++) {
    const [x, up] = [random() * width, 4 + random() * random() * 40];
    const y = ((90 - up) / 180) * height;
    const long = 26 + random() * 70;
    for (let puff = 0; puff < 16; puff++) {
      const [dx, dy] = [(random() - 0.5) * 2 * long, (random() - 0.5) * long * 0.1];
      const size = long * (0.14 + random() * 0.24);
      for (const at of [x + dx - width, x + dx, x + dx + width]) {
        context.save();
        context.translate(at, y + dy);
        context.scale(1, 0.24);
        const soft = context.createRadialGradient(0, 0, 0, 0, 0, size);
        soft.addColorStop(0, `rgb(255 255 255 / ${5 + random() * 9}%)`);
        soft.addColorStop(1, 'rgb(255 255 255 / 0%)');
        context.fillStyle = soft;
        context.fillRect(-size, -size, 2 * size, 2 * size);
        context.restore();
      }
    }
  }
}

/** The soft shadow of a rectangle that fills the middle third. */
export function shadowTexture() {
  return drawn(192, 192, (context) => {
    const { width } = context.canvas;
    const pixels = context.createImageData(width, width);
    const third = width / 3;
    for (let y = 0; y < width; y++) {
      for (let x = 0; x < width; x++) {
        const far = Math.hypot(...[x, y].map((at) => Math.max(third - at, at - 2 * third, 0))) / third;
        const dark = Math.max(0, 1 - far) ** 2.6;
        pixels.data.set([50, 42, 34, 110 * dark], 4 * (y * width + x));
      }
    }
    context.putImageData(pixels, 0, 0);
  });
}
