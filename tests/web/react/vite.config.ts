import { defineConfig } from 'vite';
import vexture, { type VextureOptions } from 'vexture/vite';

const options: VextureOptions = { precision: 1e-5, restyle: true, converter: ['python3', '-m', 'vexture'] };

export default defineConfig({ plugins: [vexture(), vexture(options)] });

// @ts-expect-error there is no such option
vexture({ presision: 1e-5 });
