// What the typesetter answers to messages, as JSON. node typesetting.mjs FILE, with { fonts: path[], messages: [] }
import { readFileSync } from 'node:fs';
import { Typesetter } from '../../web/src/typeset/typesetter.js';

const { fonts, messages } = JSON.parse(readFileSync(process.argv[2], 'utf-8'));
const typesetter = new Typesetter();
fonts.forEach((path, id) => typesetter.addFont(id, new Uint8Array(readFileSync(path)).buffer));
const plain = (_, value) => (ArrayBuffer.isView(value) ? Array.from(value) : value);
const replies = [];
for (const message of messages) replies.push((await typesetter.answer(message))?.reply ?? null);
process.stdout.write(JSON.stringify(replies, plain));
