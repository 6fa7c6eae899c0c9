// The converter of this machine: the Python program `vexture`.
import { spawn } from 'node:child_process';
import path from 'node:path';

const IS_WINDOWS = process.platform === 'win32';

/** How to get one; both lines end with one that the plugin finds. */
const REMEDY = IS_WINDOWS
  ? 'pip install vexture'
  : 'pip install vexture (or, for this project alone: python3 -m venv .venv && .venv/bin/pip install vexture)';

/**
 * @typedef {object} Converter
 * @property {string[]} command
 * @property {string} version
 */

/**
 * Run a program without a shell, so that names are names whatever is in them.
 *
 * @param {string[]} command
 * @returns {Promise<{ code: number | null, output: string, said: string }>} code null: it cannot be run
 */
export function run([program, ...parameters]) {
  return new Promise((done) => {
    const texts = { output: '', said: '' };
    const running = spawn(program, parameters, { stdio: ['ignore', 'pipe', 'pipe'], windowsHide: true });
    running.stdout.setEncoding('utf8').on('data', (text) => (texts.output += text));
    running.stderr.setEncoding('utf8').on('data', (text) => (texts.said += text));
    running.on('error', () => done({ code: null, ...texts }));
    running.on('close', (code) => done({ code, ...texts }));
  });
}

/**
 * Where a converter may be: in the project's environment, on the PATH, or a module of Python whose programs are not on it.
 *
 * @param {string} root of the project
 */
function* candidates(root) {
  yield [path.join(root, '.venv', IS_WINDOWS ? 'Scripts/vexture.exe' : 'bin/vexture')];
  yield ['vexture'];
  for (const python of ['python3', 'python']) yield [python, '-P', '-m', 'vexture']; // -P: not a folder of this name
}

/**
 * @param {string} root of the project
 * @param {string | readonly string[]} [given] instead of those that are found
 * @returns {Promise<Converter>}
 * @throws {Error} if there is none
 */
export async function findConverter(root, given) {
  const all = given === undefined ? candidates(root) : [[given].flat()];
  for (const command of all) {
    const { code, output } = await run([...command, '--version']);
    if (code === 0 && output.startsWith('vexture')) return { command, version: output.trim() };
  }
  if (given === undefined) throw new Error(`no converter is in .venv, on the PATH or in Python; type: ${REMEDY}`);
  throw new Error(`the converter ${[given].flat().join(' ')} does not run; correct the option, or type: ${REMEDY}`);
}
