// What TypeScript finds in a project and in the declarations of the package, but not in those of all other packages.
import path from 'node:path';
import { createRequire } from 'node:module';

const folder = path.resolve(process.argv[2]);
const ts = createRequire(path.join(folder, 'tsconfig.json'))('typescript');
const { config } = ts.readConfigFile(path.join(folder, 'tsconfig.json'), ts.sys.readFile);
const { fileNames, options } = ts.parseJsonConfigFileContent(config, ts.sys, folder);
const program = ts.createProgram(fileNames, options);
const ours = program.getSourceFiles().filter(({ fileName }) => /\/node_modules\/vexture\/|^((?!\/node_modules\/).)*$/.test(fileName));
const found = [...program.getOptionsDiagnostics(), ...program.getGlobalDiagnostics()];
for (const file of ours) found.push(...program.getSyntacticDiagnostics(file), ...program.getSemanticDiagnostics(file));
const host = { getCanonicalFileName: (name) => name, getCurrentDirectory: () => folder, getNewLine: () => '\n' };
console.log(`${ours.filter(({ isDeclarationFile }) => isDeclarationFile).length} declarations\n${ts.formatDiagnostics(found, host)}`);
process.exitCode = found.length > 0 ? 1 : 0;
