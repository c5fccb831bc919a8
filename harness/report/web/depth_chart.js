// The depth of a traced ray against the scene's, step by step.
import { formatShort } from 'crossray/numbers.js';
import { kDashes, svg } from 'crossray/svg.js';

const kWidth = 330;
const kHeight = 130;
const kEdge = { left: 44, right: 8, top: 16, bottom: 20 };

const isDepth = (value) => Number.isFinite(value) && value > 0 && value < 1e4; // the sky's is 1e30

/** An SVG of a trace, or null where there are not two steps. `chosen`: the step that is marked. */
export function depthChart(trace, chosen, choose) {
  const most = Math.max(...trace.backends.map((record) => record.steps.length));
  if (most < 2) return null;
  const rays = trace.backends.flatMap((record) => record.steps.map((step) => step.rayLinearDepth)).filter(isDepth);
  if (rays.length === 0) return null;
  const far = 3 * Math.max(...rays);
  const scene = trace.backends[0].steps.flatMap((step) => [step.nearest, step.nearestAndThickness]).filter((depth) => isDepth(depth) && depth < far);
  const [low, high] = [Math.min(...rays, ...scene), Math.max(...rays, ...scene)];
  const x = (i) => kEdge.left + (i / (most - 1)) * (kWidth - kEdge.left - kEdge.right);
  const y = (depth) => kHeight - kEdge.bottom - ((Math.min(Math.max(depth, low), high) - low) / (high - low || 1)) * (kHeight - kEdge.top - kEdge.bottom);
  const half = (x(1) - x(0)) / 2;
  const { steps } = trace.backends[0];
  // What the depth buffer has in a step's cell: from the nearest depth to as far as it counts as thick.
  const cells = steps.map((step, i) => isDepth(step.nearest) && svg('rect', { class: 'cell', x: x(i) - half, width: 2 * half, y: y(step.nearestAndThickness),
    height: Math.max(1.5, y(step.nearest) - y(step.nearestAndThickness)) })).filter(Boolean);
  const front = steps.map((step, i) => isDepth(step.nearest) && svg('path', { class: 'scene', d: `M${x(i) - half} ${y(step.nearest)}h${2 * half}` })).filter(Boolean);
  const lines = trace.backends.map((record, b) => svg('path', { class: `ray r${b}`, 'stroke-dasharray': b > 0 ? kDashes[b + 1] : undefined,
    d: record.steps.map((step, i) => `${i === 0 ? 'M' : 'L'}${x(i).toFixed(1)} ${y(step.rayLinearDepth).toFixed(1)}`).join('') }));
  const mark = steps[chosen] && [svg('path', { class: 'here-line', d: `M${x(chosen)} ${kEdge.top}V${kHeight - kEdge.bottom}` }),
    svg('circle', { cx: x(chosen), cy: y(steps[chosen].rayLinearDepth), r: 3.5, class: 'here' })];
  const text = (at, up, content, anchor) => { const element = svg('text', { x: at, y: up, 'text-anchor': anchor }); element.textContent = content; return element; };
  const every = Math.ceil(steps.length / 24);
  const levels = steps.map((step, i) => (i % every === 0 ? text(x(i), kHeight - 5, String(step.level), 'middle') : null)).filter(Boolean);
  const key = trace.backends.length > 1 ? `ray of ${trace.backends[0].backend}, dotted ${trace.backends[1].backend}` : 'ray';
  const chart = svg('svg', { viewBox: `0 0 ${kWidth} ${kHeight}`, role: 'img', class: 'depth-chart',
    'aria-label': `Depth of the ray and of the scene at each of ${most} steps, ${formatShort(low)} to ${formatShort(high)} m` },
  ...cells, ...front, ...lines, ...(mark || []), ...levels,
  text(kEdge.left - 4, kEdge.top + 4, formatShort(high), 'end'), text(kEdge.left - 4, kHeight - kEdge.bottom, formatShort(low), 'end'),
  text(kEdge.left - 10, kHeight - 5, 'level', 'end'), text(8, 9, `m · line: ${key} · bars: scene`, 'start'));
  chart.addEventListener('click', (event) => {
    const box = chart.getBoundingClientRect();
    const at = ((event.clientX - box.left) / box.width) * kWidth;
    choose(Math.min(most - 1, Math.max(0, Math.round(((at - kEdge.left) / (kWidth - kEdge.left - kEdge.right)) * (most - 1)))));
  });
  return chart;
}
