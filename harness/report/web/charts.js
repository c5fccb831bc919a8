// Error against cost, of what `crossray bench` measured: both axes logarithmic, an error of 0 in a band of its own, the
// methods that no other beats joined by a line. A point leads to the case whose scene it was measured on.
import { loadPiece } from 'crossray/data.js';
import { h, redraw } from 'crossray/dom.js';
import { formatShort } from 'crossray/numbers.js';
import { drawMutations } from 'crossray/mutations.js';
import { kDashes, logAxis, svg } from 'crossray/svg.js';
import { drawSweep, sweepOutputs } from 'crossray/sweeps.js';

const kCosts = { Fetches: 'reads a ray', FetchesOf32: 'reads, largest of 32 rays', Iterations: 'steps a ray', IterationsOf32: 'steps, largest of 32 rays', ratio: 'time, as a ratio to the G-buffer pass' };

function fromBench(json) {
  return json.scenes.map((scene) => ({
    title: scene.case, caseName: scene.case, where: json.fingerprint.backend,
    points: scene.methods.map((method) => ({ name: method.method, kind: method.kind, errors: method.errors,
      costs: { ...method.counters, ratio: method.milliseconds?.ratio } })),
  }));
}

function fromTracers(json) {
  const points = json.tracers.map(({ name, mean }) => ({
    name, kind: name.split(',')[0], isBound: name.startsWith('oracle'), costs: { Fetches: mean.fetches, FetchesOf32: mean.fetchesOf32, Iterations: mean.iterations },
    errors: { Wrong: mean.wrong, Missed: 1 - mean.recall, False: mean.falseShare, HitPositionSS: mean.medianPixels },
  }));
  const reliability = json.tracers.filter((tracer) => tracer.reliability?.length > 0).map(({ name, reliability: dots }) => ({ name, dots }));
  return [{ title: `${json.family}, ${json.size.join(' × ')}, ${json.tracers[0]?.scenes ?? 0} scenes`, caseName: null, where: 'C++', points, reliability }];
}

/** What a bench file holds as charts: [{title, caseName, where, points: [{name, kind, costs, errors}], reliability}]. */
export function readCharts(json) {
  return json.schema === 'crossray-tracers/1' ? fromTracers(json) : fromBench(json);
}

/** Which points no other is at most as dear and at most as wrong as. A bound, which no method is, counts for nothing. */
export function paretoFront(points) {
  return points.map((point) => !point.isBound && !points.some((other) => !other.isBound && other.cost <= point.cost && other.error <= point.error
    && (other.cost < point.cost || other.error < point.error)));
}

const kShapes = ['M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0', 'M-4 -4h8v8h-8z', 'M0 -5l5 9h-10z', 'M0 -5.5l5 5.5l-5 5.5l-5 -5.5z', 'M-5 -4h10l-5 9z'];

function drawScatter(chart, cost, error, hasCase) {
  const [width, height, left, right, top, bottom, zero] = [620, 360, 62, 14, 12, 44, 22];
  const points = chart.points.map((point) => ({ ...point, cost: point.costs[cost], error: point.errors[error] }))
    .filter((point) => point.cost > 0 && point.error >= 0 && Number.isFinite(point.error));
  const hasZero = points.some((point) => point.error === 0);
  const x = logAxis(points.map((point) => point.cost), left, width - right);
  const y = logAxis(points.map((point) => point.error), height - bottom - (hasZero ? zero : 0), top);
  const placeY = (value) => (value > 0 ? y.place(value) : height - bottom - zero / 2);
  const front = paretoFront(points);
  const kinds = [...new Set(chart.points.map((point) => point.kind))];
  const parts = [];
  for (const tick of x.ticks) {
    parts.push(svg('path', { d: `M${x.place(tick)} ${top}V${height - bottom}`, class: 'tick' }),
      svg('text', { x: x.place(tick), y: height - bottom + 14, 'text-anchor': 'middle' }, formatShort(tick)));
  }
  for (const tick of y.ticks) {
    parts.push(svg('path', { d: `M${left} ${y.place(tick)}H${width - right}`, class: 'tick' }),
      svg('text', { x: left - 6, y: y.place(tick) + 4, 'text-anchor': 'end' }, formatShort(tick)));
  }
  if (hasZero) {
    parts.push(svg('rect', { x: left, y: height - bottom - zero, width: width - left - right, height: zero, class: 'zero' }),
      svg('text', { x: left - 6, y: height - bottom - zero / 2 + 4, 'text-anchor': 'end' }, '0'));
  }
  const best = points.map((point, i) => [x.place(point.cost), placeY(point.error), front[i]]).filter((each) => each[2]).sort((a, b) => a[0] - b[0]);
  if (best.length > 1) parts.push(svg('path', { d: best.map(([px, py], i) => (i === 0 ? `M${px} ${py}` : `H${px}V${py}`)).join(''), class: 'front' }));
  points.forEach((point, i) => {
    const shape = svg('path', { d: kShapes[kinds.indexOf(point.kind) % kShapes.length], class: point.isBound ? 'point bound' : front[i] ? 'point best' : 'point',
      transform: `translate(${x.place(point.cost).toFixed(1)} ${placeY(point.error).toFixed(1)})` },
    svg('title', {}, `${point.name}: ${error} ${formatShort(point.error)} at ${formatShort(point.cost)} ${kCosts[cost]}`));
    parts.push(hasCase ? svg('a', { href: `#case=${encodeURIComponent(chart.caseName)}`, 'aria-label': `${point.name}, to its case` }, shape) : shape);
  });
  parts.push(svg('text', { x: (left + width - right) / 2, y: height - 8, 'text-anchor': 'middle', class: 'label' }, kCosts[cost]),
    svg('text', { transform: `translate(13 ${(top + height - bottom) / 2}) rotate(-90)`, 'text-anchor': 'middle', class: 'label' }, `error: ${error}`));
  return svg('svg', { viewBox: `0 0 ${width} ${height}`, role: 'group', 'aria-label': `${chart.title}: ${error} against ${kCosts[cost]}`, class: 'chart' }, ...parts);
}

function drawReliability(series) {
  const [side, left, bottom, top] = [290, 46, 40, 10];
  const x = (value) => left + side * value;
  const y = (value) => top + side * (1 - value);
  const parts = [svg('path', { d: `M${x(0)} ${y(0)}L${x(1)} ${y(1)}`, class: 'diagonal' })];
  for (const tick of [0, 0.25, 0.5, 0.75, 1]) {
    parts.push(svg('path', { d: `M${x(tick)} ${y(0)}V${y(1)}M${x(0)} ${y(tick)}H${x(1)}`, class: 'tick' }),
      svg('text', { x: x(tick), y: y(0) + 14, 'text-anchor': 'middle' }, String(tick)), svg('text', { x: left - 6, y: y(tick) + 4, 'text-anchor': 'end' }, String(tick)));
  }
  series.forEach(({ name, dots }, i) => {
    parts.push(svg('path', { d: dots.map((dot, j) => `${j === 0 ? 'M' : 'L'}${x(dot.confidence)} ${y(dot.right)}`).join(''), class: `series s${i % 4}`, 'stroke-width': 1.5, 'stroke-dasharray': kDashes[(i >> 2) % 4] }));
    for (const dot of dots) {
      parts.push(svg('circle', { cx: x(dot.confidence), cy: y(dot.right), r: Math.min(10, Math.max(2, 0.5 * dot.hits ** 0.25)), class: `dot s${i % 4}` },
        svg('title', {}, `${name}: says ${formatShort(dot.confidence)}, right ${formatShort(dot.right)}, ${dot.hits} hits`)));
    }
    parts.push(svg('text', { x: x(0) + 8, y: top + 16 + 14 * i, class: `name s${i % 4}` }, `${i >= 4 ? '┄ ' : ''}${name}`));
  });
  parts.push(svg('text', { x: x(0.5), y: y(0) + 32, 'text-anchor': 'middle', class: 'label' }, 'confidence that was given'),
    svg('text', { transform: `translate(11 ${y(0.5)}) rotate(-90)`, 'text-anchor': 'middle', class: 'label' }, 'share of these hits that are right'));
  return svg('svg', { viewBox: `0 0 ${left + side + 14} ${top + side + bottom}`, role: 'img', 'aria-label': 'Share of right hits against the confidence that was given', class: 'chart reliability' }, ...parts);
}

function drawTable(chart, cost, error) {
  const rows = chart.points.filter((point) => Number.isFinite(point.errors[error])).sort((a, b) => a.errors[error] - b.errors[error]);
  const kinds = [...new Set(chart.points.map((point) => point.kind))];
  const sign = (kind) => svg('svg', { viewBox: '-7 -7 14 14', class: 'sign', 'aria-hidden': 'true' }, svg('path', { d: kShapes[kinds.indexOf(kind) % kShapes.length], class: 'point' }));
  return h('table', { class: 'figures' }, h('caption', { class: 'hidden' }, chart.title),
    h('thead', {}, h('tr', {}, ['method', error, kCosts[cost]].map((name) => h('th', { scope: 'col' }, name)))),
    h('tbody', {}, rows.map((point) => h('tr', {}, h('th', { scope: 'row' }, sign(point.kind), point.name),
      h('td', { class: 'number' }, formatShort(point.errors[error])), h('td', { class: 'number' }, formatShort(point.costs[cost] ?? null))))));
}

function choice(label, value, choices, change) {
  return h('label', { class: 'control' }, label, h('select', { onchange: (event) => change(event.target.value) },
    choices.map(([key, text]) => h('option', { value: key, selected: key === value }, text))));
}

/** Fills the page of charts. `has(name)`: the run has that case. */
export async function drawCharts(box, { index, state, update, has }) {
  const files = await Promise.all(index.benches.map((bench) => loadPiece(bench.piece)));
  const sweeps = files.filter((file) => file.schema === 'crossray-sweep/1');
  const hunts = files.filter((file) => file.schema === 'crossray-mutation/1');
  const charts = files.filter((file) => !sweeps.includes(file) && !hunts.includes(file)).flatMap(readCharts).filter((chart) => chart.points.length > 0);
  const errors = [...new Set([...charts.flatMap((chart) => Object.keys(chart.points[0].errors)), ...sweeps.flatMap(sweepOutputs)])];
  const costs = [...new Set(charts.flatMap((chart) => Object.keys(chart.points[0].costs)))].filter((name) => name in kCosts);
  const error = errors.includes(state().error) ? state().error : '';
  const cost = costs.includes(state().cost) ? state().cost : costs[0];
  const sections = charts.map((chart) => {
    const own = Object.keys(chart.points[0].errors);
    const shown = own.includes(error) ? error : own.includes('Wrong') ? 'Wrong' : own[0];
    const hasCase = chart.caseName !== null && has(chart.caseName);
    return h('section', { class: 'chart-section' },
      h('h3', {}, hasCase ? h('a', { href: `#case=${encodeURIComponent(chart.caseName)}` }, chart.title) : chart.title, h('span', { class: 'dim' }, ` on ${chart.where}`)),
      h('div', { class: 'chart-row' }, drawScatter(chart, cost, shown, hasCase), h('div', { class: 'chart-table', tabindex: '0', role: 'region', 'aria-label': `Figures of ${chart.title}` }, drawTable(chart, cost, shown)),
        chart.reliability?.length > 0 && drawReliability(chart.reliability)));
  });
  const ofSweeps = sweeps.map((sweep) => drawSweep(sweep, sweepOutputs(sweep).includes(error) ? error : '', has(sweep.case)));
  redraw(box, h('h2', {}, charts.length > 0 ? 'Error against cost' : sweeps.length > 0 ? 'Sweeps' : 'Planted bugs'),
    h('div', { class: 'chart-controls' }, choice('error ', error, [['', 'the first of each'], ...errors.map((name) => [name, name])], (value) => update({ error: value })),
      costs.length > 0 && choice('cost ', cost, costs.map((name) => [name, kCosts[name]]), (value) => update({ cost: value })),
      h('button', { type: 'button', class: 'small', onclick: () => update({ page: '' }) }, 'back to the case')), sections, ofSweeps, hunts.map((hunt) => drawMutations(hunt, has)));
}
