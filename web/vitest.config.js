import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';

const path = (/** @type {string} */ name) => fileURLToPath(new URL(name, import.meta.url));

/** All tests run with the newest three.js and with the oldest that the package promises to work with. */
const versions = ['three', 'three-floor'];

export default defineConfig({
  test: {
    projects: versions.map((three) => ({
      resolve: {
        alias: [
          { find: /^three$/, replacement: path(`node_modules/${three}/build/three.module.js`) },
          { find: /^three\/addons\//, replacement: path(`node_modules/${three}/examples/jsm/`) },
        ],
      },
      test: {
        name: three,
        include: ['test/**/*.test.js'],
        testTimeout: 30000,
        server: { deps: { inline: [/\/examples\/jsm\//] } }, // so that what addons import is that version, too
      },
    })),
  },
});
