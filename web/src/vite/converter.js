// What converts drawings: the Python program `vexture` where this machine has one, or else this package itself.
import { readFile, writeFile } from 'node:fs/promises';
import { spawn } from 'node:child_process';
import path from 'node:path';
import { Converter as OwnConverter, convertData, writePacked } from '../convert/index.js';
import { ownOptions, parametersOf } from './options.js';

const IS_WINDOWS = process.platform === 'win32';

/** How the program begins the line of a warning. */
const WARNING = 'vexture: warning: ';

/**
 * @typedef {object} Converter
 * @property {string} version
 * @property {(file: string, options: import('./options.js').ConvertOptions, target: string) => Promise<string[]>} convert writes the
 *   texture of a file, and returns the notes
 */

/** @param {string} text */
export const linesOf = (text) => text.split('\n').filter(Boolean);

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
 * The converter of a project.
 *
 * @param {string} root of the project
 * @param {string | readonly string[] | false} [choice] a program; false is this package; by default the program if it is found
 * @returns {Promise<Converter>}
 * @throws {Error} if a chosen program does not run
 */
export async function findConverter(root, choice) {
  for (const command of choice === undefined ? candidates(root) : choice === false ? [] : [[choice].flat()]) {
    const { code, output } = await run([...command, '--version']);
    if (code === 0 && output.startsWith('vexture')) return programConverter(command, output.trim());
  }
  if (choice) throw new Error(`the converter ${[choice].flat().join(' ')} does not run; correct the option, or leave it out`);
  return packageConverter();
}

/**
 * @param {string[]} command
 * @param {string} version
 * @returns {Converter}
 */
function programConverter(command, version) {
  return {
    version,
    async convert(file, options, target) {
      const { code, said } = await run([...command, 'convert', file, ...parametersOf(options), `--output=${target}`]);
      const plain = linesOf(said).map((line) => line.replace(`${file}: `, ''));
      if (code !== 0) throw new Error(plain.at(-1)?.replace(/^(vexture|Error): /, '') ?? `the converter ended with ${code}`);
      return plain.filter((line) => line.startsWith(WARNING)).map((line) => line.slice(WARNING.length));
    },
  };
}

/** @returns {Promise<Converter>} */
async function packageConverter() {
  const { version } = JSON.parse(await readFile(new URL('../../package.json', import.meta.url), 'utf8'));
  const converter = new OwnConverter({ worker: false });
  return {
    version: `npm ${version} ${await converter.digest()}`,
    async convert(file, options, target) {
      const { strict, ...others } = ownOptions(options);
      const data = await convertData(await readFile(file), { ...others, name: path.parse(file).name, converter });
      const notes = data.notes.map(({ kind, message, count }) => `${kind === 'remark' ? '' : `${kind}: `}${message}${count > 1 ? ` (${count})` : ''}`);
      if (strict && data.notes.some(({ kind }) => kind !== 'remark')) throw new Error(`${notes.join('; ')}; leave out \`strict\`, or change the drawing`);
      await writeFile(target, await writePacked(data));
      return notes;
    },
  };
}
