import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';

/** All tests run with the newest three.js and with the oldest that the package promises to work with. */
const versions = ['three', 'three-floor'];

export default defineConfig({
  test: {
    projects: versions.map((three) => ({
      resolve: { alias: [{ find: /^three$/, replacement: fileURLToPath(new URL(`node_modules/${three}/build/three.module.js`, import.meta.url)) }] },
      test: { name: three, include: ['test/**/*.test.js'] },
    })),
  },
});
