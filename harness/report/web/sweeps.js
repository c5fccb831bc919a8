// A parameter run through the edge of a case, as `crossray sweep` measured it: each backend's largest error, below it the
// classes of cpu64 as shares of the rays, and where something jumps.
import { h } from 'crossray/dom.js';
import { formatShort, numberOf } from 'crossray/numbers.js';
import { kDashes, linearAxis, logAxis, svg } from 'crossray/svg.js';

const kClasses = { hit: 'hit', miss: 'miss', unknown: 'unknown', 'no raycast': 'none' };

/** The outputs that the sweep's case has expectations of. */
export function sweepOutputs(sweep) {
  return [...new Set(sweep.values.flatMap((row) => row.backends.flatMap((cell) => (cell.errors ?? []).map((error) => error.output))))];
}

/** One line a backend: [{backend, points: [[value, error or null]]}]; of several expectations of the output the largest. */
export function errorLines(sweep, output) {
  const errorOf = (cell) => {
    const errors = (cell?.errors ?? []).filter((error) => error.output === output).map((error) => numberOf(error.max));
    return errors.length > 0 ? Math.max(...errors) : null;
  };
  return sweep.backends.map((backend) => ({
    backend, points: sweep.values.map((row) => [row.value, errorOf(row.backends.find((cell) => cell.backend === backend))]),
  }));
}

/** Shares of a row's rays by class, reasons together; they sum to 1 where any ray was traced. */
export function classShares(row, backend) {
  const shares = Object.fromEntries(Object.keys(kClasses).map((name) => [name, 0]));
  const cell = row.backends.find((each) => each.backend === backend);
  for (const [name, share] of Object.entries(cell?.classes ?? {})) {
    const key = name.split(':')[0];
    if (key in shares) shares[key] += share;
  }
  return shares;
}

// Segments of a line, broken where there is no number.
function linePath(points, x, y) {
  let isOpen = false;
  return points.map(([value, error]) => {
    if (error === null || !Number.isFinite(error)) {
      isOpen = false;
      return '';
    }
    const part = `${isOpen ? 'L' : 'M'}${x.place(value).toFixed(1)} ${y(error).toFixed(1)}`;
    isOpen = true;
    return part;
  }).join('');
}

function drawShares(sweep, backend, x, top, height) {
  const rows = sweep.values.filter((row) => row.backends.length > 0);
  const below = rows.map(() => 0);
  return Object.entries(kClasses).map(([name, style]) => {
    const shares = rows.map((row) => classShares(row, backend)[name]);
    const edge = (level) => rows.map((row, i) => `${x.place(row.value).toFixed(1)} ${(top + height * (1 - level(i))).toFixed(1)}`);
    const lower = edge((i) => below[i]).reverse();
    shares.forEach((share, i) => (below[i] += share));
    if (shares.every((share) => share === 0)) return null;
    return svg('path', { class: `share ${style}`, d: `M${[...edge((i) => below[i]), ...lower].join('L')}Z` }, svg('title', {}, name));
  });
}

/** The chart, and what happens at each edge in words. */
export function drawSweep(sweep, wanted, hasCase) {
  const [width, height, left, right, top, bottom, band] = [720, 400, 62, 100, 14, 44, 84];
  const output = wanted || sweepOutputs(sweep)[0];
  const values = sweep.values.map((row) => row.value);
  const x = (sweep.log ? logAxis : linearAxis)(values, left, width - right);
  const lines = output ? errorLines(sweep, output) : [];
  const errors = lines.flatMap((line) => line.points.map((point) => point[1])).filter((error) => error > 0 && Number.isFinite(error));
  const floor = height - bottom - band - 14;
  const axis = logAxis(errors, floor - 16, top);
  const y = (error) => (error > 0 ? axis.place(error) : floor);
  const backend = sweep.backends.includes('cpu64') ? 'cpu64' : sweep.backends[0];
  const parts = drawShares(sweep, backend, x, height - bottom - band, band);
  for (const tick of x.ticks) {
    parts.push(svg('path', { d: `M${x.place(tick)} ${top}V${height - bottom}`, class: 'tick' }),
      svg('text', { x: x.place(tick), y: height - bottom + 14, 'text-anchor': 'middle' }, formatShort(tick)));
  }
  for (const tick of errors.length > 0 ? axis.ticks : []) {
    parts.push(svg('path', { d: `M${left} ${axis.place(tick)}H${width - right}`, class: 'tick' }),
      svg('text', { x: left - 6, y: axis.place(tick) + 4, 'text-anchor': 'end' }, formatShort(tick)));
  }
  parts.push(svg('text', { x: left - 6, y: floor + 4, 'text-anchor': 'end' }, '0'));
  sweep.edges.forEach((edge, i) => {
    const at = x.place((edge.between[0] + edge.between[1]) / 2);
    parts.push(svg('path', { d: `M${at} ${top}V${height - bottom}`, class: 'edge' }, svg('title', {}, edge.sentence)),
      svg('text', { x: at + 3, y: top + 9 + 11 * (i % 4), class: 'label' }, String(i + 1)));
  });
  lines.forEach((line, i) => {
    parts.push(svg('path', { d: linePath(line.points, x, y), class: `series s${i % 4}`, 'stroke-width': i === 0 ? 4 : 1.5, 'stroke-opacity': i === 0 ? 0.45 : 1, 'stroke-dasharray': kDashes[i % 4] }, svg('title', {}, line.backend)),
      svg('text', { x: width - right + 8, y: top + 12 + 14 * i, class: `name s${i % 4}` }, `${['━', '╌', '┈', '╍'][i % 4]} ${line.backend}`));
  });
  parts.push(svg('text', { x: (left + width - right) / 2, y: height - 8, 'text-anchor': 'middle', class: 'label' }, sweep.parameter),
    svg('text', { transform: `translate(13 ${(top + floor) / 2}) rotate(-90)`, 'text-anchor': 'middle', class: 'label' }, `largest error: ${output ?? 'none'}`),
    svg('text', { x: width - right + 8, y: height - bottom - band / 2 }, 'classes'), svg('text', { x: width - right + 8, y: height - bottom - band / 2 + 13 }, `on ${backend}`));
  const chart = svg('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', class: 'chart sweep',
    'aria-label': `${sweep.case}: largest error of ${output} on each backend against ${sweep.parameter}, and the classes of its rays` }, ...parts);
  return h('section', { class: 'chart-section' },
    h('h3', {}, hasCase ? h('a', { href: `#case=${encodeURIComponent(sweep.case)}` }, sweep.case) : sweep.case, h('span', { class: 'dim' }, ` over ${sweep.parameter}`)),
    h('p', { class: 'dim' }, sweep.summary), chart,
    h('ol', { class: 'edges' }, sweep.edges.map((edge) => h('li', {}, edge.sentence))));
}
