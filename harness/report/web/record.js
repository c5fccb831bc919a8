// The record of a traced pixel as the documents list it: what each debug mode shows there, on each backend of the trace.
import { h, redraw } from 'crossray/dom.js';
import { formatShort } from 'crossray/numbers.js';

const number = (value) => formatShort(value, 5);
const vector = (values) => values.map(number).join(', ');
const isMarch = (record) => record.tracingModel !== 'none' && !record.tracingModel.startsWith('proxy');

/** Name, what it is, and the text of a record; empty where a mode shows nothing of it. */
const kModes = [
  ['TracingModel', 'how the ray looks for its hit', (r) => r.tracingModel],
  ['RayDirWS', 'direction in world space', (r) => vector(r.rayDirWS)],
  ['start SS, depth', 'where the ray starts on screen, px and m', (r) => `${vector(r.startSS)} · ${number(r.startLinearDepth)} m`],
  ['origin WS', 'the same in world space, m', (r) => vector(r.originWS)],
  ['RayDirNDC', 'direction on screen', (r) => vector(r.rayDirSS)],
  ['levels, iterations', 'finest and coarsest level, most steps', (r) => (isMarch(r) ? `${r.minLevel} – ${r.maxLevel}, ${r.maxIterations}` : '')],
  ['thickness', 'metres that a surface counts as thick', (r) => (isMarch(r) ? `${number(r.thickness)} m` : '')],
  ['proxy', 'whether the ray meets it, and after how many metres', (r) => (r.tracingModel.startsWith('proxy') ? `${r.meetsProxy ? 'met' : 'not met'}, ${number(r.projectionDistance)} m` : '')],
  ['PathLength', 'metres in the material', (r) => (r.pathLength > 0 ? `${number(r.pathLength)} m` : '')],
  ['HitSuccess', 'class, and why', (r) => `${r.hitSuccess}${r.reason === 'none' ? '' : `, ${r.reason}`}`],
  ['PositionNDC', 'where it ends on screen, px', (r) => vector(r.endSS)],
  ['HitDepth', 'depth of the hit', (r) => (r.hitSuccess === 'hit' ? `${number(r.endLinearDepth)} m` : 'none')],
  ['IterationCount', 'steps taken', (r) => (isMarch(r) ? String(r.iterations) : '')],
  ['MaxUsedMipLevel', 'coarsest level read', (r) => (isMarch(r) ? String(r.maxUsedLevel) : '')],
  ['IntersectionKind', 'of the last step', (r) => (isMarch(r) ? r.intersection : '')],
  ['HitWeight', 'weight of the screen there', (r) => number(r.hitWeight)],
  ['Confidence', 'of a hit', (r) => (r.hitSuccess === 'hit' ? number(r.confidence) : '')],
  ['SampledColor', 'radiance read there, and its weight', (r) => `${vector(r.sampledColor)} × ${number(r.sampledColorWeight)}`],
];

const kStep = [
  ['position', 'px, as the step begins', (s) => vector(s.positionSS)],
  ['ray depth', '', (s) => `${number(s.rayLinearDepth)} m`],
  ['level', 'of the pyramid', (s) => String(s.level)],
  ['cell, size', 'column and row on the level; pixels', (s) => `${s.cell.join(', ')} · ${s.cellSize.map(number).join(' × ')}`],
  ['depth min, max', 'of the scene in the cell', (s) => `${number(s.nearest)} … ${number(s.farthest)} m`],
  ['min + thickness', '', (s) => `${number(s.nearestAndThickness)} m`],
  ['kind', 'none, cell, depth', (s) => s.intersection],
];

function rowsOf(lines, sources) {
  return lines.map(([name, title, text]) => {
    const texts = sources.map((source) => (source ? text(source) : ''));
    if (texts.every((each) => each === '')) return null;
    const differs = texts.length > 1 && texts[0] !== texts[1];
    return h('tr', {}, h('th', { scope: 'row', title }, name, differs && h('span', { class: 'differs' }, ' ≠')),
      texts.map((each, i) => (i > 0 && !differs ? null : h('td', { class: 'number', colspan: texts.length > 1 && !differs ? '2' : undefined }, each))));
  });
}

/** Fills the box, or empties it where there is no trace. */
export function drawRecord(box, trace, step) {
  if (!trace) return void box.replaceChildren();
  const records = trace.backends;
  if (!records.some((record) => record.traced)) return redraw(box, h('h3', {}, 'Record'), h('p', { class: 'dim' }, 'This pixel traces no ray.'));
  const steps = records.map((record) => record.steps[step]);
  redraw(box, h('table', { class: 'values record' },
    h('caption', {}, `Record of pixel ${trace.pixel.join(', ')}`, records.length > 1 && h('span', { class: 'dim' }, ' ≠: the two differ')),
    h('thead', {}, h('tr', {}, h('th', { scope: 'col' }, 'mode'), records.map((record) => h('th', { scope: 'col' }, record.backend)))),
    h('tbody', {}, rowsOf(kModes, records.map((record) => (record.traced ? record : null)))),
    steps.some(Boolean) && h('tbody', {}, h('tr', { class: 'first' }, h('th', { scope: 'rowgroup', colspan: String(1 + records.length) }, `step ${step}`)), rowsOf(kStep, steps))));
}
