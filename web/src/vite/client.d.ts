// Types of drawings that the plugin converts; a project names them by `/// <reference types="vexture/vite/client" />`.

/** The address of the drawing's texture, for `VectorTextureLoader` or `useVectorTexture`. */
declare module '*?vexture' {
  const url: string;
  export default url;
}

/** With options before it: `./map.geojson?restyle&vexture`. */
declare module '*&vexture' {
  const url: string;
  export default url;
}
