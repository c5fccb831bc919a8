// How the pictures are drawn: one control for each key of the state that concerns it.
import { kNoBackend } from 'crossray/choose.js';
import { h, redraw } from 'crossray/dom.js';
import { kModes } from 'crossray/views.js';

const kLayouts = { side: 'side by side', slider: 'slider', onion: 'onion', blink: 'blink', difference: 'difference alone' };

function select(label, value, choices, change, shortcut) {
  return h('label', { class: 'control' }, h('span', {}, label),
    h('select', { onchange: (event) => change(event.target.value), 'aria-keyshortcuts': shortcut },
      Object.entries(choices).map(([key, text]) => h('option', { value: key, selected: key === String(value) }, text))));
}

function range(label, id, value, { min, max, step }, change) {
  const shown = h('output', {}, value.toFixed(step < 1 ? 1 : 0));
  return h('label', { class: 'control range' }, h('span', {}, label),
    h('input', { type: 'range', id, min, max, step, value, 'aria-label': label, oninput: (event) => {
      shown.textContent = Number(event.target.value).toFixed(step < 1 ? 1 : 0);
      change(Number(event.target.value));
    } }), shown);
}

function check(label, value, change, title) {
  return h('label', { class: 'control check', title }, h('input', { type: 'checkbox', checked: value === 1, onchange: (event) => change(event.target.checked ? 1 : 0) }), label);
}

/** `shown`: what choose() found; `sources`: backends whose planes are there. */
export function drawToolbar(box, { state, shown, sources, update }) {
  if (box.contains(document.activeElement) && document.activeElement.type === 'range') return; // being moved
  const against = { expected: 'expected' };
  for (const source of sources) if (!kNoBackend.has(source) && source !== shown.backend) against[source] = source;
  const channels = { '-1': 'all' };
  const count = shown.actual?.plane.channels ?? shown.expected?.plane.channels ?? 1;
  if (count > 1) ['x', 'y', 'z', 'w'].slice(0, count).forEach((name, i) => (channels[i] = shown.type === 'color' ? 'rgb'[i] : name));
  const levels = { '-1': 'off' };
  for (let level = 0; level <= 8; ++level) levels[level] = `level ${level}`;
  redraw(box,
    select('against', state.vs in against ? state.vs : 'expected', against, (value) => update({ vs: value })),
    select('layout', state.layout, kLayouts, (value) => update({ layout: value }), 'B D'),
    select('view', state.mode, kModes, (value) => update({ mode: value })),
    select('channel', state.ch, channels, (value) => update({ ch: Number(value) })),
    range('exposure', 'exposure', state.ev, { min: -10, max: 10, step: 0.5 }, (value) => update({ ev: value })),
    range('offset', 'offset', state.off, { min: -1, max: 1, step: 0.1 }, (value) => update({ off: value })),
    select('gamma', state.gamma, { '-1': 'by type', 0: 'sRGB', 1: '1.0', 1.8: '1.8', 2.2: '2.2' }, (value) => update({ gamma: Number(value) })),
    check('normalise', state.norm, (value) => update({ norm: value })),
    select('difference', state.dx, { 1: '×1', 4: '×4', 16: '×16', 64: '×64', 1024: '×1024' }, (value) => update({ dx: Number(value) })),
    check('signed', state.signed, (value) => update({ signed: value })),
    select('cells', state.grid, levels, (value) => update({ grid: Number(value) })),
    check('hatch', state.hatch, (value) => update({ hatch: value }), 'stripes over the pixels that are not compared (rising) or cannot be decided (falling)'),
    check('worst', state.worst, (value) => update({ worst: value }), 'a circle with a cross at the pixel with the largest error'),
    h('button', { type: 'button', class: 'small', onclick: () => update({ z: 0, cx: 0.5, cy: 0.5 }) }, 'fit'),
    h('button', { type: 'button', class: 'small', onclick: () => update({ mode: 'auto', ev: 0, off: 0, norm: 0, ch: -1, gamma: -1, dx: 1, signed: 0 }) }, 'reset'));
}
