// A report opened from disk as a person opens it: what is shown against what the run's files say.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { clickPixel, colorAt, crossray, kPixelOfNaN, makeFaultyRun, openPage, placeOfPixel, readExrPart, until } from './fixture.mjs';

const kWidth = 48;
const kHeight = 36;
let folder;
let report;
let single;
let depth; // of lavapipe, from its EXR

before(() => {
  folder = makeFaultyRun();
  report = join(folder, 'out/last/report/index.html');
  const made = crossray(folder, 'report', 'out/last', '--single');
  assert.equal(made.code, 0, made.err);
  single = join(folder, 'out/last/report.html');
  depth = readExrPart(join(folder, 'out/last/planes/floor/depth/lavapipe.exr'), 'HitDepth');
});

const namesIn = (page) => page.locator('[role=option] .name').allTextContents();
const valueOf = (page, source) => page.locator('.values tbody tr', { has: page.locator(`th:text-is("${source}")`) }).first().locator('td').allTextContents();
const pixelOf = (page) => page.locator('.coordinates input').evaluateAll((inputs) => inputs.map((input) => input.value).join());
const bitsOf = (value) => { const view = new DataView(new ArrayBuffer(4)); view.setFloat32(0, value); return view.getUint32(0).toString(16).padStart(8, '0'); };

async function checkTheWholeWay(file) {
  const { page, complaints, close } = await openPage(file);
  await page.locator('.pane.actual canvas').waitFor();
  assert.match(await page.title(), /failed/);
  assert.deepEqual(await namesIn(page), ['floor/depth', 'sky/class', 'direction'], 'failures first, the others by folder');

  // It opens at the worst pixel of the first failure.
  assert.equal(await page.locator('.case-title h2').textContent(), 'floor/depth');
  assert.equal(await pixelOf(page), kPixelOfNaN.join());
  assert.deepEqual((await valueOf(page, 'lavapipe')).slice(0, 2), ['NaN', '7fc00000']);
  assert.match(await page.locator('.pane.actual .facts').textContent(), /1 NaN$/);
  // A pixel: the value shown is the float of the plane, bit for bit.
  for (const [x, y] of [[24, 25], [10, 33], [47, 35]]) {
    await clickPixel(page, 'actual', x, y, kWidth, kHeight);
    await until(() => pixelOf(page), (shown) => shown === `${x},${y}`, 'the pixel that was clicked');
    const [value, bits] = await valueOf(page, 'lavapipe');
    assert.equal(Math.fround(Number(value)), depth.at(x, y));
    assert.equal(bits, bitsOf(depth.at(x, y)));
  }

  // NaN is magenta.
  await until(() => placeOfPixel(page, 'actual', ...kPixelOfNaN, kWidth, kHeight).then((place) => colorAt(page, 'actual', place)),
    (color) => color.join() === '255,0,255', 'the NaN is drawn in magenta');

  // The filter.
  await page.fill('#filter', 'b:cpu64 s:failed');
  await until(() => namesIn(page), (names) => names.join() === 'sky/class', 'failed on cpu64');
  await page.fill('#filter', '@mirror');
  await until(() => namesIn(page), (names) => names.join() === 'direction', 'by a tag');
  await page.fill('#filter', 'o:HitDepth "of a hit"');
  await until(() => namesIn(page), (names) => names.join() === 'floor/depth', 'an output and words');
  await page.fill('#filter', 'nowhere');
  assert.equal(await page.locator('.empty').textContent(), 'No case fits the filter.');
  await page.fill('#filter', '');

  // The other failure has its own worst pixel, its class table and its commands.
  await page.locator('[data-name="sky/class"]').click();
  await until(() => page.locator('.case-title h2').textContent(), (name) => name === 'sky/class', 'the case that was clicked');
  assert.match(await page.locator('.confusion').textContent(), /886/);
  const commands = await page.locator('#commands code').allTextContents();
  assert.match(commands[0], /^crossray run cases\/sky\/class.toml --backend /);
  assert.match(commands[1], /^\[\[known_failure\]\]/);
  assert.deepEqual(complaints, []);
  await close();
}

test('the folder opens from disk', () => checkTheWholeWay(report));

test('the single file opens from disk, alone', async () => {
  assert.ok(readFileSync(single).length < 20e6);
  const { cpSync } = await import('node:fs');
  cpSync(single, join(folder, 'sent/away.html'), { recursive: true });
  assert.ok(!existsSync(join(folder, 'sent/data')));
  await checkTheWholeWay(join(folder, 'sent/away.html'));
});

test('the trace of the worst pixel is stepped through', async () => {
  const { page, complaints, close } = await openPage(`${report}#case=floor/depth&a=lavapipe`);
  const trace = JSON.parse(readFileSync(join(folder, 'out/last/planes/floor/depth/lavapipe.trace.json'), 'utf8'));
  await page.locator('.steps tbody tr').first().waitFor();
  const record = trace.backends[0];
  const cells = () => page.locator('.steps tr.shown td').allTextContents();
  for (const step of [0, 1, 2]) {
    await page.keyboard.press('PageDown');
    await until(cells, (found) => found[0] === String(step), 'the chosen step');
    const shown = await cells();
    assert.equal(shown[1], String(record.steps[step].level));
    assert.equal(shown[2], record.steps[step].cell.join());
    assert.equal(shown[3], record.steps[step].intersection);
  }
  await page.keyboard.press('PageUp');
  await until(cells, (found) => found[0] === '1', 'one back');
  await page.locator('.steps tbody tr').nth(3).click();
  await until(cells, (found) => found[0] === '3', 'a step that was clicked');
  await until(() => page.url(), (url) => /step=3/.test(url), 'the step in the address');
  assert.deepEqual(complaints, []);
  await close();
});

test('a link leads to its view, and a changed address changes the view', async () => {
  const { page, complaints, close } = await openPage(`${report}#case=floor/depth&a=cpu32&o=IterationCount&vs=lavapipe&x=12&y=30&layout=slider&split=0.25&mode=signed&ev=1.5&grid=2`);
  await page.locator('.pane.both canvas').waitFor();
  assert.equal(await pixelOf(page), '12,30');
  assert.equal(await page.locator('.tab[aria-pressed=true]').first().textContent(), '✓cpu32 pass');
  assert.match(await page.locator('.pane.both .title').textContent(), /^lavapipe \| actual: cpu32$/);
  assert.equal(await page.locator('.split').inputValue(), '0.25');
  const chosen = await page.locator('#toolbar select').evaluateAll((all) => all.map((each) => each.value));
  assert.deepEqual([chosen[0], chosen[1], chosen[2], chosen[6]], ['lavapipe', 'slider', 'signed', '2']);
  await page.evaluate(() => { location.hash = '#case=floor/direction&x=3&y=30&o=RayDirWS'; });
  await until(() => page.locator('.case-title h2').textContent(), (name) => name === 'floor/direction', 'the address of another case');
  await until(() => pixelOf(page), (shown) => shown === '3,30', 'its pixel');
  // What the page writes leads back to the same view.
  await page.keyboard.press('ArrowRight');
  await until(() => page.url(), (url) => url.includes('x=4'), 'the pixel in the address');
  const again = await openPage(page.url());
  await again.page.locator('.pane.actual canvas').waitFor();
  assert.equal(await pixelOf(again.page), '4,30');
  assert.deepEqual([...complaints, ...again.complaints], []);
  await again.close();
  await close();
});

test('planes are compared side by side, by slider, onion, blink and difference', async () => {
  const { page, complaints, close } = await openPage(`${report}#case=floor/depth&a=lavapipe&vs=cpu64&x=12&y=20&mode=map&worst=0`);
  const panes = () => page.locator('figure.pane').evaluateAll((all) => all.map((each) => each.className.replace('pane ', '')).join());
  const layout = page.locator('#toolbar label', { hasText: 'layout' }).locator('select');
  await until(panes, (found) => found === 'expected,against,actual,difference', 'side by side');
  const there = async (pane, x, y) => colorAt(page, pane, await placeOfPixel(page, pane, x, y, kWidth, kHeight));
  const painted = (pane) => until(() => there(pane, 24, 33), (color) => color.some((each) => each > 0), `${pane} is painted`);
  await painted('actual');
  const exact = readExrPart(join(folder, 'out/last/planes/floor/depth/cpu64.exr'), 'HitDepth');
  const find = (fits) => {
    for (let y = 0; y < kHeight; ++y) for (let x = 24; x < kWidth; ++x) if (depth.at(x, y) > 0 && fits(depth.at(x, y), exact.at(x, y))) return [x, y];
    throw new Error('no pixel is like that');
  };
  const same = find((a, b) => a === b);
  const wrong = find((a, b) => a > b * 1.0005);
  const nan = await there('actual', ...kPixelOfNaN);
  assert.equal(nan.join(), '255,0,255');

  await layout.selectOption('slider');
  await until(panes, (found) => found === 'both,difference', 'slider');
  const setSplit = (value) => page.locator('.split').evaluate((slider, to) => { slider.value = to; slider.dispatchEvent(new Event('input')); }, value);
  await setSplit('0'); // all of it actual
  await until(() => there('both', ...kPixelOfNaN), (color) => color.join() === '255,0,255', 'the slider at its left shows actual');
  await setSplit('1');
  await until(() => there('both', ...kPixelOfNaN), (color) => color.join() !== '255,0,255', 'at its right what it is held against');

  await layout.selectOption('onion');
  await setSplit('1');
  await until(() => there('both', ...kPixelOfNaN), (color) => color.join() === '255,0,255', 'the onion at its end shows actual');
  await setSplit('0.5');
  await until(() => there('both', ...kPixelOfNaN), (color) => color.join() !== '255,0,255' && color[0] > 100, 'half of it in its middle');

  await page.keyboard.press('b');
  await until(panes, (found) => found === 'both,difference', 'blink');
  const seen = new Set();
  await until(async () => seen.add((await there('both', ...kPixelOfNaN)).join()), (colors) => colors.size >= 2, 'both in turn');
  assert.ok(seen.has('255,0,255'));

  await page.keyboard.press('d');
  await until(panes, (found) => found === 'difference', 'the difference alone');
  await painted('difference');
  const [sound, off] = [await there('difference', ...same), await there('difference', ...wrong)];
  assert.deepEqual(sound, [16, 17, 20], 'equal is black');
  assert.ok(off.some((each) => each > 60) && off[1] > 60, `beyond is bright: ${off}`);
  assert.deepEqual(complaints, []);
  await close();
});
