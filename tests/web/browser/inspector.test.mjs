// The inspector against its server: what is drawn against what `crossray trace` says, parameters, saving, and a server that goes.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { caseOf, clickPixel, colorAt, crossray, findBarriers, kDepthIsTrue, makeFolder, placeOfPixel, until, write } from './fixture.mjs';
import { nextRender, opened, slide, startInspector, textOf } from './inspector.mjs';

const kWidth = 48;
const kHeight = 36;

let folder;

before(() => {
  folder = makeFolder();
  write(folder, 'cases/floor/depth.toml', caseOf('floor/depth', 'The depth of a hit is that of the wall.', kDepthIsTrue));
});

test('a click traces the ray and draws it where the record says', async () => {
  const { url } = await startInspector(folder);
  // Answers are late, as on a slow machine: the pixel is named at once, its steps come when they are there.
  let release;
  const released = new Promise((done) => (release = done));
  const prepare = (fresh) => fresh.route('**/trace', async (route) => { await released; await route.continue(); });
  const { page, complaints, close } = await opened(`${url}#case=floor/depth&a=lavapipe&o=HitDepth&b=lavapipe,cpu64&beside=none&worst=0`, { prepare });
  await clickPixel(page, 'actual', 24, 28, kWidth, kHeight);
  const panel = () => textOf(page, '#trace');
  await until(panel, (text) => text.startsWith('Trace of pixel 24, 28') && text.includes('being traced'), 'the pixel before its trace');
  release();
  await until(panel, (text) => text.startsWith('Trace of pixel 24, 28') && text.includes('Steps of the march'), 'the trace of the pixel');
  const said = crossray(folder, 'trace', 'floor/depth', '--pixel', '24,28', '--backend', 'lavapipe', '--json');
  const [record] = JSON.parse(said.out).backends;
  const rows = await page.locator('.steps tbody tr').evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  assert.equal(rows.length, record.steps.length);
  rows.forEach((cells, i) => {
    const { level, cell, intersection, positionSS } = record.steps[i];
    assert.deepEqual(cells.slice(1, 5), [String(level), cell.join(), intersection, positionSS.map((v) => v.toFixed(3)).join(', ')]);
  });
  // On the picture: the colour of the ray at each step that skips, and the ring around the hit.
  const isRay = ([r, g, b]) => r < 190 && g > 200 && b > 210;
  const at = async ([x, y], dx = 0) => {
    const [left, top] = await placeOfPixel(page, 'actual', x - 0.5, y - 0.5, kWidth, kHeight);
    return colorAt(page, 'actual', [left + dx, top]);
  };
  await until(() => at(record.endSS, 5), isRay, 'the ring at the end');
  const far = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]) > 2; // not under the signs of the start and the end
  const skipping = record.steps.filter((step) => step.intersection === 'none' && far(step.positionSS, record.startSS) && far(step.positionSS, record.endSS));
  assert.ok(skipping.length > 1);
  for (const step of skipping) assert.ok(isRay(await at(step.positionSS)), `a step at ${step.positionSS}`);
  assert.ok(!isRay(await at([10, 30])), 'and nowhere else');
  // The record beside it, and the chart below.
  assert.match(await textOf(page, '#record'), new RegExp(`HitSuccess${record.hitSuccess}.*IterationCount${record.iterations}`));
  assert.match(await page.locator('.depth-chart').getAttribute('aria-label'), new RegExp(`each of ${record.steps.length} steps`));
  // A step is chosen by key, and its cell is drawn.
  await page.keyboard.press('PageDown');
  await until(() => textOf(page, '#record'), (text) => text.includes('step 0'), 'the record of the step');
  // With Home the ray follows the mouse.
  await page.keyboard.press('Home');
  await page.mouse.move(...await placeOfPixel(page, 'actual', 30, 31, kWidth, kHeight));
  await until(() => textOf(page, '#trace h2'), (title) => title.startsWith('Trace of pixel 30, 31'), 'the pixel under the mouse');
  // Beside another backend: where the two part, or that they do not.
  await page.locator('.trace-head select').selectOption('cpu64');
  await until(() => textOf(page, '.trace-facts'), (text) => text.includes('cpu64'), 'two backends');
  assert.deepEqual(complaints, []);
  await close();
});

test('a parameter renders again, and what is changed is saved as a case', async () => {
  const { url } = await startInspector(folder);
  const { page, complaints, close } = await opened(`${url}#case=floor/depth&a=lavapipe&b=lavapipe&o=HitDepth&x=24&y=28`);
  const valueOf = () => page.locator('.values tbody tr.shown td').first().textContent();
  const before = await valueOf();
  await nextRender(page, () => slide(page, 'camera.fov', 75));
  await until(valueOf, (value) => value !== before, 'another value');
  await until(() => page.url(), (address) => address.includes('p=camera.fov=75'), 'the parameter in the address');
  const wide = await valueOf();
  // The number box says the same and takes what the slider cannot.
  assert.equal(await page.locator('#control-camera-fov').inputValue(), '75');
  await nextRender(page, async () => {
    await page.locator('#control-camera-fov').fill('75.25');
    await page.keyboard.press('Enter');
  });
  assert.notEqual(await valueOf(), wide);
  // By keyboard alone.
  await page.locator('#control-camera-fov-slider').focus();
  await nextRender(page, () => page.keyboard.press('ArrowRight'));
  await nextRender(page, () => slide(page, 'camera.fov', 75));
  assert.equal(await valueOf(), wide, 'the same parameters give the same value');

  // Saved: the file runs and gives what was shown.
  await page.locator('#save-name').fill('wide');
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  const saved = (await until(() => page.locator('.live-status').last().textContent(), (text) => text.includes('saved'), 'saved')).replace(/^.*saved: /, '');
  assert.ok(existsSync(join(folder, saved)) || existsSync(saved), saved);
  const file = existsSync(saved) ? saved : join(folder, saved);
  assert.match(readFileSync(file, 'utf8'), /fov\s*=\s*75/);
  const run = crossray(folder, 'run', file, '--backend', 'lavapipe', '--no-report', '--progress', 'none', '-o', 'out/saved');
  assert.match(run.out, /1 passed, 0 failed|0 passed, 1 failed/, run.err);
  const trace = JSON.parse(crossray(folder, 'trace', file, '--pixel', '24,28', '--backend', 'lavapipe', '--json').out);
  assert.equal(Math.fround(trace.backends[0].endLinearDepth), Math.fround(Number(wide)));
  // Never over another file.
  await page.locator('#save-name').fill('wide');
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await until(() => page.locator('.live-status').last().textContent(), (text) => text.startsWith('✕'), 'refused');

  // Reset gives the case back; a link gives the change back.
  const link = page.url();
  await nextRender(page, () => page.getByRole('button', { name: /^Reset all/ }).click());
  assert.equal(await valueOf(), before);
  const again = await opened(link);
  await until(() => again.page.locator('.values tbody tr.shown td').first().textContent(), (value) => value === wide, 'the value of the link');
  // One answer was refused on purpose: the browser notes it.
  assert.deepEqual(complaints.concat(again.complaints).filter((text) => !text.includes('409')), []);
  await again.close();
  await close();
});

test('long work shows its progress and ends when it is cancelled', async () => {
  const { url } = await startInspector(folder);
  const { page, close } = await opened(`${url}#case=floor/depth&b=cpu64`);
  await page.locator('details.parameters', { hasText: 'scene' }).first().evaluate((group) => (group.open = true));
  for (const side of ['scene-size-0', 'scene-size-1']) {
    await page.locator(`#control-${side}`).fill('2048');
    await page.keyboard.press('Enter');
  }
  const cancel = page.getByRole('button', { name: 'Cancel' });
  await cancel.waitFor();
  await cancel.click();
  await until(() => page.locator('.live-status').first().textContent(), (text) => text.includes('cancelled'), 'cancelled');
  assert.equal(await cancel.isVisible(), false);
  await nextRender(page, () => page.getByRole('button', { name: /^Reset all/ }).click());
  await close();
});

test('a server that is killed is said, and found again when it is back', async () => {
  const first = await startInspector(folder);
  const { page, close } = await opened(`${first.url}#case=floor/depth&a=lavapipe&b=lavapipe&x=24&y=28`);
  assert.equal(await page.locator('#banner').isVisible(), false);
  const ended = new Promise((done) => first.server.on('exit', done));
  first.server.kill('SIGKILL');
  await ended;
  await page.locator('#banner').waitFor({ timeout: 8000 }); // nobody touches the page
  assert.match(await textOf(page, '#banner'), /does not answer/);
  assert.deepEqual(await findBarriers(page), []);
  await slide(page, 'camera.fov', 70); // taken when it is back
  await startInspector(folder, first.port);
  await until(() => page.locator('#banner').isVisible(), (visible) => !visible, 'the banner goes');
  await until(() => page.locator('.live-status').first().textContent(), (text) => text.startsWith('rendered'), 'rendered again');
  await nextRender(page, () => slide(page, 'camera.fov', 72));
  await close();
});

for (const scheme of ['light', 'dark']) {
  test(`axe-core finds nothing in the inspector, ${scheme}`, async () => {
    const { url } = await startInspector(folder);
    const { page, complaints, close } = await opened(`${url}#case=floor/depth&b=lavapipe,cpu64&x=24&y=28&step=2&p=camera.fov=70`, { scheme });
    await page.locator('.steps').waitFor();
    assert.deepEqual(await findBarriers(page), []);
    for (const group of await page.locator('details.parameters').all()) await group.evaluate((element) => (element.open = true));
    assert.deepEqual(await findBarriers(page), []);
    assert.deepEqual(complaints, []);
    await close();
  });
}

test('every control is reached by Tab and has a name', async () => {
  const { url } = await startInspector(folder);
  const { page, close } = await opened(`${url}#case=floor/depth&b=lavapipe`);
  await page.locator('#control-camera-fov').waitFor();
  await page.locator('.backends input').first().focus();
  const reached = new Set();
  for (let i = 0; i < 150; ++i) {
    await page.keyboard.press('Tab');
    const id = await page.evaluate(() => document.activeElement.closest('.controls') && (document.activeElement.id || document.activeElement.getAttribute('aria-label') || document.activeElement.textContent));
    if (id === null) break;
    reached.add(id);
  }
  for (const wanted of ['control-camera-fov', 'control-camera-fov-slider', 'save-name', 'Save']) assert.ok(reached.has(wanted), `${wanted}: ${[...reached]}`);
  await close();
});
