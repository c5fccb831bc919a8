// The keyboard, and the page that explains it.
import { h } from 'crossray/dom.js';

const kKeys = [
  ['?', 'this page'], ['/', 'filter the cases'], ['[  ]', 'case before, case after'], ['1 – 9', 'output'],
  ['Shift (hold)', 'expected in place of actual'], ['B', 'blink'], ['D', 'difference alone'],
  ['E, Shift E', 'exposure half a stop up, down'], ['arrows', 'move the pixel; with Shift by 8'],
  ['U, Y', 'pixel with the next smaller, next larger difference'], ['W', 'worst pixel'], ['PageUp, PageDown', 'trace step'],
  ['Home', 'the pixel follows the mouse'], ['+  −  0', 'zoom in, out, fit'], ['Esc', 'close, leave the filter'],
];

const kFilter = [
  ['s:failed', 'verdict, or passed, failed, skipped'], ['b:osmesa', 'backend'], ['o:HitDepth', 'output'],
  ['@probe', 'tag'], ['"two words"', 'in name or summary'], ['!slow', 'not'],
];

const kSigns = [
  ['✕ ✓ –', 'failed, passed, skipped'], ['!  #  T', 'error, crash, time-out'], ['≈  ?', 'failed as known, passed against that'], ['∅', 'no golden file'],
  ['stripes up, down', 'not compared; undecidable'], ['circle with cross', 'worst pixel'], ['square', 'pixel on the right'],
  ['magenta', 'NaN; in a difference: no number tells'], ['yellow, cyan', '+infinity, −infinity'],
];

function table(caption, rows) {
  return h('table', { class: 'help' }, h('caption', {}, caption),
    h('tbody', {}, rows.map(([key, text]) => h('tr', {}, h('th', { scope: 'row' }, h('kbd', {}, key)), h('td', {}, text)))));
}

/** Opens the dialog with a title and content. */
export function openDialog(title, ...content) {
  const dialog = document.getElementById('dialog');
  dialog.replaceChildren(h('h2', { id: 'dialog-title' }, title), ...content,
    h('form', { method: 'dialog' }, h('button', { type: 'submit' }, 'Close')));
  if (!dialog.open) dialog.showModal();
}

export function openHelp() {
  openDialog('Help', h('div', { class: 'help-columns' }, table('Keys', kKeys), h('div', {}, table('Filter', kFilter), table('Signs', kSigns))),
    h('p', {}, 'Drag moves the pictures, the wheel zooms, a double click fits. The address holds all that is shown: copy it to share a view.'));
}

const isText = (element) => element?.matches?.('input:not([type=range]):not([type=checkbox]), select, textarea');

/** `actionOf(key)`: what main.js does at a key, which gets the event; none: the browser has it. */
export function listenToKeys(actionOf, holdShift) {
  addEventListener('keydown', (event) => {
    if (event.key === 'Shift') holdShift(true);
    if (event.ctrlKey || event.metaKey || event.altKey || document.getElementById('dialog').open) return;
    const target = event.target;
    if (event.key === 'Escape' && isText(target)) target.blur();
    if (isText(target) || (target.type === 'range' && event.key.startsWith('Arrow'))) return;
    if ((target.closest?.('.steps-box, [role=listbox]')) && /^(Arrow|Page|Home|End)/.test(event.key) && !event.key.startsWith('Page')) return;
    const action = actionOf(event.key.length === 1 ? event.key.toLowerCase() : event.key);
    if (!action) return;
    event.preventDefault();
    action(event);
  });
  addEventListener('keyup', (event) => event.key === 'Shift' && holdShift(false));
  addEventListener('blur', () => holdShift(false));
}
