// The sheet that shows the map, and the lines between the states on it.
import { DoubleSide, Matrix3, Mesh, PlaneGeometry } from 'three';
import { VectorMaterial } from 'vexture';

const BEND = 0.85; // radians from the middle of the sheet to its left and right side

/** A square sheet, 2 wide, bent around an upright axis; its uv are those of the texture. */
function bent() {
  const geometry = new PlaneGeometry(2, 2, 64, 1);
  const { position } = geometry.attributes;
  for (let i = 0; i < position.count; i++) {
    const angle = BEND * position.getX(i);
    position.setX(i, Math.sin(angle) / BEND);
    position.setZ(i, (Math.cos(angle) - 1) / BEND);
  }
  geometry.computeBoundingSphere();
  return geometry;
}

/** From the unit square of a texture to its source. */
const toSource = (texture) => new Matrix3().set(...texture.roots[0].transform, 0, 0, 1);

/** Both as meshes of one geometry: what rays meet is the first one. */
export function surfaceOf(counties, borders) {
  const map = new VectorMaterial({ texture: counties, mode: 'paint', side: DoubleSide });
  const place = toSource(borders).invert().multiply(new Matrix3().makeScale(1, -1)).multiply(toSource(counties));
  const lines = new VectorMaterial({ texture: borders, color: 0x10161d, transform: place, side: DoubleSide, depthTest: false });
  const meshes = [map, lines].map((material) => new Mesh(bent(), material));
  meshes[1].renderOrder = 1;
  map.mask.attach(meshes[0]); // rays tell the county: hit.element
  return meshes;
}
