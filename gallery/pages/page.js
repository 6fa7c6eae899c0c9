// A page of an example: runs what the editor holds in a frame of its own.
(() => {
  const about = JSON.parse(document.getElementById('about').textContent);
  const byId = (id) => document.getElementById(id);
  const [editor, stage, note, run, reset, copy] = ['editor', 'stage', 'note', 'run', 'reset', 'copy'].map(byId);
  const isFile = location.protocol === 'file:';
  let frame = null;

  const script = (address) => `<script src="${address}"></script>`;
  const asJson = (value) => JSON.stringify(value).replaceAll('<', '\\u003c');

  function documentOf(source) {
    const libraries = about.libraries.map((name) => `../lib/${name}${isFile ? '.text' : ''}.js`);
    const scripts = [...libraries, ...(isFile && about.files ? ['files.js'] : [])];
    if (about.jsx) scripts.push('../jsx.js');
    return `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>${about.title}</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>html, body { height: 100%; margin: 0; overflow: hidden; font: 14px/1.4 system-ui, sans-serif; } canvas { display: block; touch-action: none; outline: none; }</style>
<script type="application/json" id="source">${asJson({ source, jsx: about.jsx })}</script>
${scripts.map(script).join('\n')}</head><body>${script('../frame.js')}</body></html>`;
  }

  function show() {
    note.hidden = true;
    document.documentElement.dataset.state = 'starting';
    const next = Object.assign(document.createElement('iframe'), { title: `${about.title}, running`, srcdoc: documentOf(editor.value) });
    if (frame) frame.replaceWith(next);
    else stage.append(next);
    frame = next;
    reset.disabled = editor.value === about.source;
  }

  addEventListener('message', ({ source, data }) => {
    if (source !== frame?.contentWindow || !data?.gallery) return;
    document.documentElement.dataset.state = data.gallery;
    if (data.gallery !== 'error' || !note.hidden) return; // the first error says most
    note.textContent = data.line ? `line ${data.line}: ${data.message}` : data.message;
    note.hidden = false;
  });

  // on a phone the source is folded, so that the picture comes first
  byId('code').open = !matchMedia('(max-width: 60rem)').matches;
  if (!about.libraries) return; // a page that stands by itself
  editor.value = about.source; // browsers keep what was typed before a reload
  editor.addEventListener('input', () => (reset.disabled = editor.value === about.source));
  editor.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter' || !(event.ctrlKey || event.metaKey)) return;
    event.preventDefault();
    show();
  });
  run.addEventListener('click', show);
  reset.addEventListener('click', () => {
    editor.value = about.source;
    show();
  });
  copy.addEventListener('click', async () => {
    editor.select();
    try {
      await navigator.clipboard.writeText(editor.value);
    } catch {
      document.execCommand('copy'); // where there is no clipboard, as on pages from the disk
    }
    copy.textContent = 'Copied';
    setTimeout(() => (copy.textContent = 'Copy'), 1500);
  });
  show();
})();
