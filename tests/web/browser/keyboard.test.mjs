// Every key of the help's table, and that all can be done without a mouse.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { clickPixel, colorAt, kPixelOfNaN, makeFaultyRun, openPage, placeOfPixel, until } from './fixture.mjs';

let report;
before(() => { report = join(makeFaultyRun(), 'out/last/report/index.html'); });

const caseOf = (page) => page.locator('.case-title h2').textContent();
const pixelOf = (page) => page.locator('.coordinates input').evaluateAll((inputs) => inputs.map((input) => Number(input.value)));
const outputOf = (page) => page.locator('.tab[aria-pressed=true][aria-keyshortcuts]').textContent();
const hashOf = async (page, key) => new URLSearchParams(new URL(page.url()).hash.slice(1)).get(key);

test('every key of the table does what the table says', async () => {
  const { page, complaints, close } = await openPage(`${report}#case=floor/depth&a=lavapipe&mode=map`);
  await page.locator('.pane.actual canvas').waitFor();
  const press = (key) => page.keyboard.press(key);
  const hash = (key, value, what) => until(() => hashOf(page, key), (found) => found === value, what);
  const tested = new Set();
  const key = (name) => tested.add(name);

  key('?');
  await press('?');
  await page.locator('dialog[open]').waitFor();
  const table = await page.locator('dialog table').first().locator('th').allTextContents();
  await press('Escape');
  await until(() => page.locator('dialog[open]').count(), (count) => count === 0, 'Escape closes');

  key('/');
  key('Esc');
  await press('/');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'filter');
  await press('Escape');
  assert.notEqual(await page.evaluate(() => document.activeElement.id), 'filter');

  key('[  ]');
  await press(']');
  await until(() => caseOf(page), (name) => name === 'sky/class', 'the case after');
  await press('[');
  await until(() => caseOf(page), (name) => name === 'floor/depth', 'the case before');
  await page.locator('.pane.actual canvas').waitFor();

  key('1 – 9');
  await press('2');
  const names = await page.locator('.tab[aria-keyshortcuts]').allTextContents();
  await until(() => outputOf(page), (name) => name === names[1] && name.startsWith('2'), 'the second output');
  await press('1');
  await until(() => outputOf(page), (name) => name === names[0], 'the first output');

  key('Shift (hold)');
  await press('1');
  const depthTab = names.findIndex((name) => name.includes('HitDepth')) + 1;
  await press(String(depthTab));
  await clickPixel(page, 'actual', 30, 12, 48, 36); // away from where the colour is read
  const there = async () => colorAt(page, 'actual', await placeOfPixel(page, 'actual', ...kPixelOfNaN, 48, 36));
  await until(there, (color) => color.join() === '255,0,255', 'actual has a NaN there');
  await page.keyboard.down('Shift');
  await until(there, (color) => color.join() !== '255,0,255', 'expected has none');
  await page.keyboard.up('Shift');
  await until(there, (color) => color.join() === '255,0,255', 'actual again');

  key('B');
  await press('b');
  await hash('layout', 'blink', 'blink');
  await press('b');
  await hash('layout', null, 'no more');
  key('D');
  await press('d');
  await hash('layout', 'difference', 'difference');
  await press('d');
  await hash('layout', null, 'no more');

  key('E, Shift E');
  await press('e');
  await hash('ev', '0.5', 'half a stop up');
  await press('Shift+E');
  await hash('ev', null, 'half a stop down');

  key('arrows');
  const at = await pixelOf(page);
  for (const [name, dx, dy] of [['ArrowRight', 1, 0], ['ArrowDown', 0, 1], ['ArrowLeft', -1, 0], ['ArrowUp', 0, -1], ['Shift+ArrowLeft', -8, 0], ['Shift+ArrowUp', 0, -8]]) {
    await press(name);
    at[0] += dx;
    at[1] += dy;
    assert.deepEqual(await pixelOf(page), at, name);
  }

  key('W');
  await press('w');
  assert.deepEqual(await pixelOf(page), kPixelOfNaN);
  key('U, Y');
  await press('u');
  const place = () => page.locator('.coordinates .dim').textContent();
  assert.match(await place(), /^2 of /);
  await press('y');
  assert.match(await place(), /^1 of /);
  assert.deepEqual(await pixelOf(page), kPixelOfNaN);

  key('PageUp, PageDown');
  await page.locator('.steps').waitFor();
  await press('PageDown');
  await press('PageDown');
  await hash('step', '1', 'the second step');
  await press('PageUp');
  await hash('step', '0', 'the first');

  key('Home');
  await press('Home');
  const move = async (x, y) => page.mouse.move(...await placeOfPixel(page, 'actual', x, y, 48, 36));
  await move(5, 30);
  await until(() => pixelOf(page), (found) => found.join() === '5,30', 'the pixel follows');
  await press('Home');
  await move(9, 9);
  assert.deepEqual(await pixelOf(page), [5, 30]);

  key('+  −  0');
  await press('+');
  await until(() => hashOf(page, 'z'), (zoom) => Number(zoom) > 1, 'zoomed');
  const zoom = Number(await hashOf(page, 'z'));
  await press('-');
  await until(() => hashOf(page, 'z'), (found) => Number(found) < zoom, 'and back');
  await press('0');
  await hash('z', null, 'fits');

  assert.deepEqual(table.filter((name) => !tested.has(name)), [], 'keys of the table that this test leaves out');
  assert.deepEqual(complaints, []);
  await close();
});

test('everything is reached by Tab, and a case is chosen from the list by keys', async () => {
  const { page, close } = await openPage(`${report}#case=floor/depth&a=lavapipe`);
  await page.locator('.pane.actual canvas').waitFor();
  const reached = [];
  for (let i = 0; i < 120; ++i) {
    await page.keyboard.press('Tab');
    const name = await page.evaluate(() => {
      const { activeElement: element } = document;
      if (element === document.body) return '';
      const box = element.closest('section, aside, header, main')?.id || element.closest('section, aside, header, main')?.className;
      return `${box}: ${element.tagName} ${element.id || element.getAttribute('aria-label') || element.textContent}`;
    });
    if (name === '' && reached.length > 5) break;
    reached.push(name);
  }
  assert.equal(reached[0], 'undefined: A skip');
  for (const part of ['top', 'list', 'case-head', 'toolbar', 'panes', 'pixel', 'trace', 'commands']) {
    assert.ok(reached.some((name) => name.startsWith(`${part}:`)), `${part} is reached: ${reached}`);
  }
  const wanted = await page.locator('button:visible, select:visible, input:visible').count();
  assert.ok(reached.length >= wanted, `${reached.length} stops for ${wanted} controls`);

  await page.locator('#cases').focus();
  await page.keyboard.press('ArrowDown');
  await until(() => caseOf(page), (name) => name === 'sky/class', 'the next in the list');
  await clickPixel(page, 'actual', 3, 3, 48, 36);
  assert.deepEqual(await pixelOf(page), [3, 3]);
  await close();
});
