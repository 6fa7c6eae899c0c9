// Runs in the frame of an example: gives its source the libraries of the page by an import map, and tells the page what
// goes wrong. A page from the disk may not load modules, nor fetch files: the libraries are classic scripts, and the
// files are given by `files.js`. Scripts from the disk are of another origin, and browsers hide what their errors say:
// there the libraries come as text, and are scripts of this page.
(() => {
  for (const [name, text] of Object.entries(globalThis.galleryTexts ?? {})) {
    document.head.append(Object.assign(document.createElement('script'), { textContent: `${text}\n//# sourceURL=${name}.js` }));
  }

  const { source, jsx } = JSON.parse(document.getElementById('source').textContent);
  const modules = globalThis.galleryModules;

  /** @param {string} kind @param {string} [message] @param {number} [line] */
  const tell = (kind, message = '', line = 0) => parent.postMessage({ gallery: kind, message: message.split('\n')[0], line }, '*');
  const inLine = ({ stack = '' }) => Number(/gallery-example\.js:(\d+)/.exec(stack)?.[1] ?? 0);
  addEventListener('error', ({ message, filename, lineno, error }) => {
    const own = filename.endsWith('gallery-example.js') || error instanceof SyntaxError ? lineno : 0;
    tell('error', message.replace(/^Uncaught /, '').replace(/Failed to execute 'append' on 'Element': /, ''), own || inLine(error ?? {}));
  });
  addEventListener('unhandledrejection', ({ reason }) => tell('error', String(reason), inLine(reason ?? {})));
  const { error } = console;
  console.error = (...parts) => {
    error.apply(console, parts);
    tell('error', parts.map(String).join(' '));
  };

  // a module that hands on what a script has brought
  function forwarded(name) {
    const names = Object.keys(modules[name]).filter((one) => one !== 'default');
    const all = `globalThis.galleryModules[${JSON.stringify(name)}]`;
    const main = 'default' in modules[name] ? `export default ${all}.default;` : '';
    return `data:text/javascript,${encodeURIComponent(`export const { ${names} } = ${all};${main}`)}`;
  }

  const files = globalThis.galleryFiles ?? {};
  const { DefaultLoadingManager } = modules.three ?? modules['three/webgpu'] ?? {};
  DefaultLoadingManager?.setURLModifier((url) => files[url] ?? url);
  const { fetch } = globalThis;
  globalThis.fetch = (what, options) => fetch(files[what] ?? what, options);

  const append = (type, text) => document.body.append(Object.assign(document.createElement('script'), { type, textContent: text }));
  const imports = Object.fromEntries(Object.keys(modules).map((name) => [name, forwarded(name)]));
  append('importmap', JSON.stringify({ imports }));
  globalThis.galleryRan = () => tell('ran');
  try {
    const compiled = jsx ? globalThis.galleryJsx(source) : source;
    append('module', `${compiled}\nglobalThis.galleryRan();\n//# sourceURL=gallery-example.js`);
  } catch (wrong) {
    tell('error', String(wrong), wrong.line);
  }
})();
