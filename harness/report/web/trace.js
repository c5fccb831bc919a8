// The bottom: what the ray of the pixel did, when a trace of it is at hand; else the command that prints it.
import { traceCommand } from 'crossray/commands.js';
import { loadPiece } from 'crossray/data.js';
import { depthChart } from 'crossray/depth_chart.js';
import { commandLine, h, redraw, say } from 'crossray/dom.js';
import { formatShort } from 'crossray/numbers.js';

const dropped = []; // traces that a person gave to the page

/** A trace's JSON with its numbers as numbers: NaN and infinities are strings there. */
export function reviveTrace(value) {
  if (Array.isArray(value)) return value.map(reviveTrace);
  if (value && typeof value === 'object') return Object.fromEntries(Object.entries(value).map(([key, each]) => [key, reviveTrace(each)]));
  return value === 'NaN' ? NaN : value === 'Infinity' ? Infinity : value === '-Infinity' ? -Infinity : value;
}

/** Takes the text of a trace; throws where it is none. Returns it. */
export function addTrace(text) {
  const trace = reviveTrace(JSON.parse(text));
  if (trace.schema !== 'crossray-trace/1') throw new Error('no JSON of crossray trace --json');
  dropped.unshift(trace);
  return trace;
}

/** The trace of a case's pixel, of the backend where there is one; or null. */
export async function findTrace(index, name, x, y, backend) {
  const given = dropped.find((trace) => trace.case === name && trace.pixel[0] === x && trace.pixel[1] === y);
  if (given) return given;
  const all = index.traces.filter((trace) => trace.case === name && trace.x === x && trace.y === y);
  const known = all.find((trace) => trace.backends.includes(backend)) ?? all[0];
  return known ? reviveTrace(await loadPiece(known.piece)) : null;
}

/** Pixels of a case that have a trace. */
export function tracedPixels(index, name) {
  const pixels = index.traces.filter((trace) => trace.case === name).map((trace) => [trace.x, trace.y])
    .concat(dropped.filter((trace) => trace.case === name).map((trace) => trace.pixel));
  return [...new Map(pixels.map((pixel) => [pixel.join(), pixel])).values()]; // several backends may have the same
}

const kColumns = [
  ['step', 'counted from 0'], ['level', 'of the depth pyramid; 0 has the pixels themselves'], ['cell', 'column and row on that level'],
  ['met', 'none: the cell is skipped; cell: looked at closer, or passed; depth: a hit'], ['position, px', 'of the ray as the step begins'],
  ['ray, m', 'depth of the ray there'], ['nearest, m', 'nearest depth of the scene in the cell'], ['farthest, m', 'farthest depth of the scene in the cell'],
  ['+ thick, m', 'the nearest depth and the thickness that a surface counts as'],
];

function stepRow(trace, record, number, step, chosen, choose) {
  const parted = trace.parting && trace.parting.step >= 0 && number >= trace.parting.step;
  const several = trace.backends.length > 1;
  return h('tr', { class: `${number === chosen ? 'shown' : ''} ${parted ? 'parted' : ''}`, onclick: () => choose(number) },
    [String(number), String(step.level), step.cell.join(','), step.intersection, step.positionSS.map((v) => v.toFixed(3)).join(', '),
      ...[step.rayLinearDepth, step.nearest, step.farthest, step.nearestAndThickness].map((v) => formatShort(v, 6))].map((text) => h('td', { class: 'number' }, text)),
    several && h('td', {}, parted ? record.backend : 'both'));
}

function stepTable(trace, chosen, choose) {
  const most = Math.max(...trace.backends.map((record) => record.steps.length));
  const parted = trace.parting && trace.parting.step >= 0 ? trace.parting.step : most;
  const rows = [];
  for (let i = 0; i < most; ++i) {
    for (const record of trace.backends) {
      if (!record.steps[i]) continue;
      rows.push(stepRow(trace, record, i, record.steps[i], chosen, choose));
      if (i < parted) break; // both did the same
    }
  }
  return h('table', { class: 'steps' },
    h('caption', { class: 'hidden' }, 'Steps of the march'),
    h('thead', {}, h('tr', {}, kColumns.map(([name, title]) => h('th', { scope: 'col', title }, name)), trace.backends.length > 1 && h('th', { scope: 'col' }, 'backend'))),
    h('tbody', {}, rows));
}

function facts(record) {
  if (!record.traced) return 'this pixel traces no ray';
  const place = (position, depth) => `(${position.map((v) => v.toFixed(2)).join(', ')}) px ${formatShort(depth, 5)} m`;
  const way = record.tracingModel.startsWith('proxy') ? `${formatShort(record.projectionDistance, 5)} m to the proxy, no march`
    : `${record.iterations} of ${record.maxIterations} steps`;
  return [`${record.tracingModel}, ${record.hitSuccess}${record.reason === 'none' ? '' : ` (${record.reason})`}`,
    record.pathLength > 0 && `${formatShort(record.pathLength, 5)} m in the material`,
    `${place(record.startSS, record.startLinearDepth)} → ${place(record.endSS, record.endLinearDepth)}`, way,
    `weight ${formatShort(record.hitWeight)}`].filter(Boolean).join(' · ');
}

// A line a backend; one for both where they say the same.
function factLines(trace) {
  const lines = new Map();
  for (const record of trace.backends) lines.set(facts(record), [...(lines.get(facts(record)) ?? []), record.backend]);
  return [...lines].map(([text, backends]) => h('p', {}, h('b', {}, backends.join(', ')), `: ${text}`));
}

// Where the two part, or that they do not: then the backend is not alone with its answer.
function verdict(trace) {
  if (trace.parting) return h('p', { class: 'warn' }, trace.parting.sentence);
  return trace.backends.length > 1 && h('p', { class: 'dim' }, `${trace.backends.map((record) => record.backend).join(' and ')} take the same way to the same kind of answer.`);
}

function fileInput(added) {
  return h('label', { class: 'file' }, 'or open its JSON: ', h('input', { type: 'file', accept: '.json,application/json', onchange: async (event) => {
    try {
      for (const file of event.target.files) added(addTrace(await file.text()));
    } catch (error) {
      say(`no trace: ${error.message}`);
    }
  } }));
}

// The inspector: which backend is traced beside the shown one.
function besideSelect({ backends, chosen, update }) {
  return h('label', { class: 'control' }, 'beside it ', h('select', { onchange: (event) => update({ beside: event.target.value }) },
    h('option', { value: 'none', selected: chosen.length < 2 }, 'none'),
    backends.filter((name) => name !== chosen[0]).map((name) => h('option', { value: name, selected: name === chosen[1] }, name))));
}

function withoutTrace({ item, shown, x, y, index, update, added, live }) {
  if (live) return [h('p', { class: live.error ? 'failed' : 'dim' }, live.error ? `✕ ${live.error}` : x < 0 ? 'Click a pixel: its ray is traced and drawn.' : 'being traced …')];
  const others = tracedPixels(index, item.name);
  const partner = shown.isAgainstBackend ? [shown.against.title] : shown.expectation?.source.startsWith('agree with ')
    ? [shown.expectation.source.slice('agree with '.length)] : [];
  return [
    shown.result?.traceNote ? h('p', { class: 'dim' }, `The run kept no trace of the worst pixel: ${shown.result.traceNote}.`) : '',
    x >= 0 ? commandLine('shows its ray', `${traceCommand(item, x, y, [shown.backend, ...partner])}`) : '',
    x >= 0 ? commandLine('into this report', `${traceCommand(item, x, y, [shown.backend, ...partner], true)} > pixel.json && crossray report ${index.runFolder} --trace pixel.json`) : '',
    fileInput(added),
    others.length > 0 ? h('p', { class: 'dim' }, 'traced: ', others.map(([px, py]) => h('button', { type: 'button', class: 'small', onclick: () => update({ x: px, y: py }) }, `${px}, ${py}`))) : '',
  ];
}

// How far down a box's steps are. To ask the table itself costs a layout of the whole page.
const scrolledTo = new WeakMap();

/**
 * `context`: {item, shown, x, y, trace (or null), step, index, update, added(trace), live}. `live`, in the inspector:
 * {backends: names, chosen: those that are traced, error}.
 */
export function drawTracePanel(box, context) {
  const { x, y, trace, step, update, live } = context;
  const at = trace ? trace.pixel : [x, y];
  const title = h('h2', {}, at[0] >= 0 ? `Trace of pixel ${at.join(', ')}` : 'Trace');
  const beside = live ? besideSelect({ ...live, update }) : '';
  if (!trace) return redraw(box, h('div', { class: 'trace-head' }, title, beside), withoutTrace(context));
  const hasSteps = trace.backends.some((record) => record.steps.length > 0);
  const choose = (value) => update({ step: value });
  const table = hasSteps && h('div', { class: 'steps-box', tabindex: '0', role: 'region', 'aria-label': 'Steps', onscroll: (event) => scrolledTo.set(box, event.target.scrollTop) }, stepTable(trace, step, choose));
  title.append(h('span', { class: 'dim' }, ' · diamond: start; dot: skips a cell; square: looks closer; ring: hit; cross: none'));
  redraw(box, h('div', { class: 'trace-head' }, title, beside), h('div', { class: 'trace-facts' }, factLines(trace), verdict(trace)),
    hasSteps && h('div', { class: 'trace-body' }, table, depthChart(trace, step, choose) ?? ''));
  if (!hasSteps) return;
  if (scrolledTo.get(box) > 0) table.scrollTop = scrolledTo.get(box);
  table.querySelector('tr.shown')?.scrollIntoView({ block: 'nearest' });
}
