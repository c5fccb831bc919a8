// The right side: one pixel, each output on each backend, as exact as the planes are.
import { h, redraw } from 'crossray/dom.js';
import { className, floatHex, formatFloat, formatShort, pixelError, ulpDistance, unitOf } from 'crossray/numbers.js';

function valueText(type, value) {
  return type === 'class' ? `${formatFloat(value)} ${className(value)}` : formatFloat(value);
}

function ulpText(expected, value) {
  const distance = ulpDistance(expected, value);
  return distance === 0 ? '0' : Number.isFinite(distance) ? String(distance) : '∞';
}

const loudClass = (value) => (Number.isNaN(value) ? 'nan' : Number.isFinite(value) ? '' : 'inf');

// One source of the output that is looked at: a row a channel.
function valueRows(label, values, type, reference, error) {
  return values.map((value, channel) => h('tr', { class: channel === 0 ? 'first' : '' },
    h('th', { scope: 'row' }, channel === 0 ? label : h('span', { class: 'hidden' }, `${label}, channel ${channel + 1}`)),
    h('td', { class: `number ${loudClass(value)}` }, valueText(type, value)),
    h('td', { class: 'number dim' }, floatHex(value).slice(2)),
    h('td', { class: 'number' }, reference && type !== 'class' ? ulpText(reference[channel], value) : ''),
    h('td', { class: 'number' }, channel === 0 && error !== null ? (error === Infinity ? '∞' : formatShort(error, 3)) : '')));
}

function mainTable({ shown, planesOf, item, x, y }) {
  const expected = shown.expected?.plane.pixel(x, y);
  const reference = shown.against?.plane.pixel(x, y) ?? null;
  const rows = [];
  if (expected) rows.push(...valueRows('expected', expected, shown.type, shown.isAgainstBackend ? reference : null, null));
  for (const { backend } of item.results) {
    const plane = planesOf.get(backend)?.find((each) => each.name === shown.output);
    if (!plane) continue;
    const values = plane.pixel(x, y);
    const error = reference ? pixelError(shown.type, reference, values) : null;
    const rowsOfBackend = valueRows(backend, values, shown.type, reference, error);
    if (backend === shown.backend) rowsOfBackend.forEach((row) => row.classList.add('shown'));
    rows.push(...rowsOfBackend);
  }
  if (rows.length === 0) return h('p', { class: 'dim' }, 'no plane of this output was kept');
  return h('table', { class: 'values' },
    h('caption', {}, `${shown.output}${shown.unit ? `, ${shown.unit}` : ''}`, shown.isAgainstBackend && h('span', { class: 'dim' }, ` against ${shown.against.title}`)),
    h('thead', {}, h('tr', {}, ['source', 'value', 'bits', 'ulp', unitOf(shown.type)].map((name) => h('th', { scope: 'col' }, name)))),
    h('tbody', {}, rows));
}

function sourceLine({ shown, mask, x, y }) {
  const { expectation } = shown;
  if (!expectation) return null;
  const isCompared = !mask || mask[y * shown.actual.plane.width + x];
  return h('p', { class: 'dim' }, shown.expected ? 'expected by ' : 'held to ', h('b', {}, expectation.source),
    expectation.tolerance === 'exact' ? ', exactly' : `, within ${expectation.tolerance}`,
    isCompared ? '' : h('span', { class: 'warn' }, '; this pixel is not compared'));
}

// Every other output: its value on the shown backend, and which backends say something else.
function otherOutputs({ shown, planesOf, item, x, y, outputs, update }) {
  const rows = shown.names.filter((name) => name !== shown.output).map((name) => {
    const type = outputs.find((each) => each.name === name)?.type ?? 'scalar';
    const answers = item.results.map(({ backend }) => [backend, planesOf.get(backend)?.find((plane) => plane.name === name)?.pixel(x, y)])
      .filter(([, values]) => values);
    if (answers.length === 0) return null;
    const own = (answers.find(([backend]) => backend === shown.backend) ?? answers[0])[1];
    const differ = answers.filter(([, values]) => values.some((value, i) => ulpDistance(value, own[i]) !== 0 && !(Number.isNaN(value) && Number.isNaN(own[i]))));
    const brief = own.map((value) => (type === 'class' ? className(value) : formatShort(value, 6))).join('  ');
    return h('details', { class: 'output' },
      h('summary', {}, h('span', { class: 'output-name' }, name), h('span', { class: 'number' }, brief),
        differ.length > 0 && h('span', { class: 'differs', title: `${differ.map(([backend]) => backend).join(', ')} differ from the value shown, bit for bit` }, `≠ ${differ.length}`)),
      h('table', { class: 'values small-values' },
        h('caption', { class: 'hidden' }, `${name} on each backend`),
        h('tbody', {}, answers.flatMap(([backend, values]) => valueRows(backend, values, type, own, null)))),
      h('button', { type: 'button', class: 'small', onclick: () => update({ o: name, e: -1 }) }, `show ${name}`));
  });
  return rows;
}

const kCauses = ['', 'depth', 'the normal', 'the camera', 'a setting', 'a probe', 'history or motion', 'all inputs together'];

// What the run measured of conditioning here, where the pixel is beyond its bound.
function undecidableLine({ shown, planesOf, undecidableAbove, x, y }) {
  const planes = planesOf.get('conditioning');
  const at = (kind) => planes?.find((plane) => plane.name === `${shown.output}@${kind}`)?.at(x, y);
  const condition = at('condition');
  if (!(condition > undecidableAbove)) return null;
  const cause = kCauses[at('cause')] ?? '';
  return h('p', { class: 'warn' }, `undecidable here: ${shown.output} ${condition === Infinity ? 'flips' : `moves by ${formatShort(condition, 3)} ulp`} for an ulp of ${cause || 'an input'}`);
}

/** `context`: {shown, planesOf, item, x, y, mask, outputs, rank, update, goTo(step), undecidableAbove, live}. */
export function drawPixel(box, outputsBox, context) {
  const { shown, x, y, update, rank } = context;
  const plane = shown.actual?.plane ?? shown.expected?.plane;
  if (!plane || x < 0) {
    outputsBox.replaceChildren();
    box.replaceChildren(h('h2', {}, 'Pixel'), h('p', { class: 'dim' }, context.live ? 'Nothing is rendered yet.' : 'No planes of this case are in the report. The run keeps those of cases with a failure, or all with --planes all.'));
    return;
  }
  const isOpen = new Set([...outputsBox.querySelectorAll('details[open] .output-name')].map((each) => each.textContent));
  const number = (label, value, max, change) => h('label', {}, label, h('input', {
    type: 'number', min: '0', max: String(max), value: String(value), onchange: (event) => change(Math.min(max, Math.max(0, Math.trunc(Number(event.target.value) || 0)))),
  }));
  const place = rank.indexOf(y * plane.width + x);
  const coordinates = h('div', { class: 'coordinates' },
    number('x', x, plane.width - 1, (value) => update({ x: value })),
    number('y', y, plane.height - 1, (value) => update({ y: value })),
    h('button', { type: 'button', class: 'small', 'aria-keyshortcuts': 'Y', onclick: () => context.goTo(-1) }, '‹ larger'),
    h('button', { type: 'button', class: 'small', 'aria-keyshortcuts': 'U', onclick: () => context.goTo(1) }, 'smaller ›'),
    h('span', { class: 'dim' }, place >= 0 ? `${place + 1} of ${context.differing} by difference` : rank.length > 0 ? 'no difference here' : ''));
  redraw(box, h('h2', {}, 'Pixel'), coordinates, mainTable(context), sourceLine(context), undecidableLine(context));
  redraw(outputsBox, h('h3', {}, 'Every output'), otherOutputs(context));
  for (const each of outputsBox.querySelectorAll('details')) each.open = isOpen.has(each.querySelector('.output-name').textContent);
}
