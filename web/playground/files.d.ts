// What the build of the playground puts in place of files.
declare module '*.svg' {
  const text: string;
  export default text;
}
declare module 'playground-worker' {
  const text: string;
  export default text;
}
declare module 'playground-map' {
  const text: string;
  export default text;
}
declare module 'playground-maps' {
  const bytes: Uint8Array<ArrayBuffer>;
  export default bytes;
}
declare module 'playground-silhouettes' {
  const bytes: Uint8Array<ArrayBuffer>;
  export default bytes;
}
declare module 'playground-strokes' {
  const bytes: Uint8Array<ArrayBuffer>;
  export default bytes;
}
declare module '*.woff' {
  const bytes: Uint8Array<ArrayBuffer>;
  export default bytes;
}
