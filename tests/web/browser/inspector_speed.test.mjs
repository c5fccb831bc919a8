// How long a person waits in the inspector.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { caseOf, clickPixel, kDepthIsTrue, makeFolder, until, write } from './fixture.mjs';
import { opened, slide, startInspector } from './inspector.mjs';

// Reached are 50 ms from click to drawn ray and 150 ms for a rendering where processors are idle and quick. What holds on any
// machine is how much the page, the server and the way between them add to what the shader takes there at the same time: twice
// its time where nothing else runs, nearly three times on a machine with four programs a processor, ten times when answers were packed.
const kMostOfTrace = 4, kMostOfRender = 3.5;
const kGoals = { trace: 50, render: 150 };

/** Does something, and waits for another count of `attribute`; what the panel says then: {seen, backend}, milliseconds. */
async function timed(page, query, attribute, act) {
  const status = page.locator(query).first();
  const count = async () => Number(await status.getAttribute(attribute) ?? 0);
  const before = await count();
  await act();
  await until(count, (now) => now > before, `another of ${query}`);
  const text = await status.textContent();
  await page.waitForTimeout(60);
  return { seen: Number(await status.getAttribute('data-seen')), backend: Number(text.match(/lavapipe ([\d.]+) ms/)[1]) };
}

const middle = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

/** Of pairs of times: the least, and by how much the whole is more than its part. */
function sum(times) {
  const warm = times.slice(2);
  return { least: Math.min(...warm.map(({ seen }) => seen)), middle: middle(warm.map(({ seen }) => seen)), ratio: middle(warm.map(({ seen, backend }) => seen / backend)) };
}

test('page and server add little to what the shader takes', async (t) => {
  const folder = makeFolder();
  write(folder, 'cases/floor/large.toml', caseOf('floor/large', 'The depth of a hit is that of the wall.', kDepthIsTrue).replace('[48, 36]', '[256, 256]'));
  const { url } = await startInspector(folder);
  const { page, close } = await opened(`${url}#case=floor/large&a=lavapipe&o=HitDepth&b=lavapipe&beside=none`);
  const traces = [], renders = [];
  for (let i = 0; i < 14; ++i) traces.push(await timed(page, '.trace-time', 'data-traces', () => clickPixel(page, 'actual', 60 + 9 * i, 180 + 4 * i, 256, 256)));
  for (let i = 0; i < 14; ++i) renders.push(await timed(page, '.live-status', 'data-renders', () => slide(page, 'camera.fov', 50 + i)));
  await close();
  const [trace, render] = [sum(traces), sum(renders)];
  for (const [name, { least, middle, ratio }] of Object.entries({ trace, render })) {
    t.diagnostic(`${name}: ${least.toFixed(0)} ms at least, ${middle.toFixed(0)} ms in the middle, ${ratio.toFixed(2)} times lavapipe's own`);
  }
  const holds = ({ least, ratio }, most, goal) => least <= goal || ratio <= most;
  assert.ok(holds(trace, kMostOfTrace, kGoals.trace), `from click to drawn ray: ${JSON.stringify(traces)}`);
  assert.ok(holds(render, kMostOfRender, kGoals.render), `renderings: ${JSON.stringify(renders)}`);
});
