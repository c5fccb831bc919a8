// Elements in few words. Text goes in as text: what a run says is never read as HTML.

/** h('p', {class: 'x', onclick: f}, 'text', child, ...) */
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (name in element && typeof value !== 'string' && typeof value !== 'number') element[name] = value;
    else element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

/** Draws `box` anew and gives the focus back to the control that stands where the focused one stood. */
export function redraw(box, ...content) {
  const controls = () => [...box.querySelectorAll('button, select, input, summary, [tabindex]')];
  const at = controls().indexOf(document.activeElement);
  box.replaceChildren(...content.flat().filter((child) => child !== null && child !== undefined && child !== false));
  if (at >= 0) controls()[at]?.focus({ preventScroll: true });
}

const kMarks = {
  pass: '✓', fail: '✕', error: '!', crash: '#', timeout: 'T', skip: '–', 'known-fail': '≈', 'unknown-pass': '?', 'missing-golden': '∅',
};

/** A verdict as sign and word: colour is never the only sign. */
export function verdictMark(verdict, tally) {
  return h('span', { class: `mark ${tally}`, 'aria-hidden': 'true' }, kMarks[verdict] ?? '·');
}

let noteTimer = 0;

/** Says something for some seconds at the lower edge. */
export function say(text) {
  const note = document.getElementById('note');
  note.textContent = text;
  clearTimeout(noteTimer);
  noteTimer = setTimeout(() => (note.textContent = ''), 4000);
}

export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = h('textarea', { style: 'position:fixed;opacity:0' }, text);
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
  say('copied');
}

/** A line of code with a button that copies it. */
export function commandLine(label, text) {
  return h('div', { class: 'command' },
    h('span', { class: 'command-label' }, label),
    h('code', {}, text),
    h('button', { type: 'button', class: 'small', 'aria-label': `Copy: ${label}`, onclick: () => copyText(text) }, 'copy'));
}
