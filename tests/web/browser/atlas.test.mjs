// The atlas as a page of a report: the document's rows, what the run says of their cases, the curves, and the keyboard.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { caseOf, crossray, findBarriers, kDepthIsTrue, makeFolder, openPage, repository, until, write } from './fixture.mjs';

const kAtlas = readFileSync(join(repository, 'docs/stability.md'), 'utf8');
const kSweep = 'reports/published/sweeps/hiz_bias.svg';
let report;
let single;

// Cases of the atlas' names: one file of two that hold, one that fails, and one that the atlas does not know.
before(() => {
  const folder = makeFolder();
  write(folder, 'cases/stability/28_behind_an_object.toml', `${caseOf('stability/28_behind_an_object', 'Depths are those of the wall.', kDepthIsTrue)}\n[expand]\ncamera.fov = [50, 60]\n`);
  write(folder, 'cases/stability/29_the_cap_is_no_hit.toml', caseOf('stability/29_the_cap_is_no_hit', 'Every ray meets something, which is false.', '\n[[expect]]\noutput = "HitSuccess"\nconstant = "hit"\nwhere = "all"\n'));
  write(folder, 'cases/floor/own.toml', caseOf('floor/own', 'Depths are those of the wall.', kDepthIsTrue));
  const run = crossray(folder, 'run', '--backend', 'cpu32,cpu64', '--progress', 'none', '-j2');
  assert.equal(run.code, 1, run.out + run.err);
  assert.equal(crossray(folder, 'report', 'out/last', '--single').code, 0);
  report = join(folder, 'out/last/report/index.html');
  single = join(folder, 'out/last/report.html');
});

const rowOf = (page, words) => page.locator('.atlas-table tbody tr', { hasText: words });
const titleOf = (page) => page.locator('dialog[open] h2').textContent();

async function openAtlas(more = '', options = {}) {
  const opened = await openPage(`${report}#page=atlas${more}`, options);
  await opened.page.locator('.atlas-table').first().waitFor();
  return opened;
}

test('it has every row of the document, with the verdict of each case that the run has', async () => {
  const { page, complaints, close } = await openAtlas();
  const rows = kAtlas.split('\n').filter((line) => /^\| (-|\d+(, \d+)*) \| /.test(line));
  assert.equal(await page.locator('.atlas-table tbody tr').count(), rows.length);
  const sections = kAtlas.split('\n').filter((line) => line.startsWith('## ')).map((line) => line.slice(3));
  assert.deepEqual(await page.locator('.atlas-section h3').allTextContents(), sections);
  // A row, cell by cell.
  const [number, where, fails, returned, instead] = await rowOf(page, 'behind an object').first().locator('td').allTextContents();
  assert.equal(number, '28, 36');
  assert.match(where, /^behind an object ✓ passed 4thickness 0 and huge not in this run$/);
  const cells = rows.find((line) => line.includes('28_behind_an_object')).split(' | ');
  assert.deepEqual([fails, returned, instead], cells.slice(2, 5).map((cell) => cell.replaceAll('`', '')));
  assert.match(await rowOf(page, 'a loop of 100,000 steps').locator('.verdict.failed').textContent(), /failed 2$/);
  assert.equal(await page.locator('.c1 a').count(), 2, 'links to the cases that the run has');
  const hiz = page.locator('.atlas-contents li', { hasText: 'HiZ' });
  assert.match(await hiz.textContent(), /✕ failed 2 of 6$/);

  // To the case that failed, and back.
  await page.locator('.c1 a', { hasText: 'the cap' }).click();
  await until(() => page.locator('.case-title h2').textContent(), (name) => name === 'stability/29_the_cap_is_no_hit', 'the case');
  await until(() => page.locator('#atlas').isVisible(), (visible) => !visible, 'in the place of the atlas');
  await page.goBack();
  await until(() => page.locator('#atlas').isVisible(), Boolean, 'the way back');

  // And from another case to its row.
  await page.locator('[data-name^="stability/28"], [data-name="28_behind_an_object[fov=50]"]').first().click();
  const toAtlas = page.locator('.case-title a', { hasText: 'in the atlas' });
  await toAtlas.click();
  await until(() => page.locator('.atlas-table tr.shown .c0').allTextContents(), (numbers) => numbers.join() === '28, 36', 'its row');
  assert.equal(await page.evaluate(() => document.activeElement.textContent), 'behind an object');
  await page.locator('[data-name="floor/own"]').click();
  await until(() => page.locator('.case-title h2').textContent(), (name) => name === 'floor/own', 'a case that the atlas does not know');
  assert.equal(await toAtlas.count(), 0);
  assert.deepEqual(complaints, []);
  await close();
});

test('every picture is there, and a curve opens with its sentences', async () => {
  const { page, complaints, close } = await openAtlas();
  const linked = new Set([...kAtlas.matchAll(/\]\(([^)#]+\.(?:svg|png))\)/g)].map((match) => match[1].replace(/^\.\.\//, '').replace(/^images/, 'docs/images')));
  const sources = await page.locator('#atlas img').evaluateAll((images) => Promise.all(images.map(async (image) => {
    image.loading = 'eager';
    await image.decode();
    return [new URLSearchParams(image.closest('a').hash.slice(1)).get('figure'), image.naturalWidth];
  })));
  assert.deepEqual([...new Set(sources.map(([path]) => path))].sort(), [...linked].sort());
  assert.ok(sources.every(([, width]) => width > 200), JSON.stringify(sources));

  const curve = rowOf(page, 'behind an object').first().locator('.figure-link');
  await curve.focus();
  await page.keyboard.press('Enter');
  await page.locator('dialog[open] img').waitFor();
  const said = readFileSync(join(repository, 'reports/published/sweeps/README.md'), 'utf8').split('\n## ').find((part) => part.includes('](hiz_bias.svg)'));
  assert.equal(await titleOf(page), said.split('\n')[0]);
  const text = await page.locator('dialog[open]').textContent();
  for (const word of ['Shows.', 'Edge.', 'Why.']) assert.ok(text.includes(word), word);
  assert.ok(text.includes(said.match(/\*\*Why\.\*\* (.*)/)[1]));
  assert.match(text, /Case: reflection\/hiz_room not in this run/);
  assert.deepEqual(await findBarriers(page), []);
  await until(() => page.url(), (url) => decodeURIComponent(url).includes(`figure=${kSweep}`), 'the picture in the address');
  await page.keyboard.press('Escape');
  await until(() => page.locator('dialog[open]').count(), (count) => count === 0, 'Escape closes it');
  await until(() => page.url(), (url) => !url.includes('figure='), 'the address without it');
  assert.ok(await curve.evaluate((element) => element === document.activeElement), 'the focus is where it was');
  assert.deepEqual(complaints, []);
  await close();
});

test('a link leads to a method or a curve, and keys scroll the page and move no pixel', async () => {
  const { page, complaints, close } = await openAtlas('&at=planar-probes');
  const heading = page.locator('#at-planar-probes');
  await until(() => heading.evaluate((element) => element === document.activeElement), Boolean, 'the method has the focus');
  await until(() => heading.evaluate((element) => element.getBoundingClientRect().top), (top) => top > 0 && top < 200, 'and is on top');
  const place = () => page.locator('#atlas').evaluate((box) => box.scrollTop);
  const start = await place();
  assert.ok(start > 1000);
  for (const key of ['PageUp', 'ArrowUp', 'PageDown', 'ArrowDown', 'Home', 'End']) {
    const before = await place();
    await page.keyboard.press(key);
    await until(place, (now) => now !== before, `${key} scrolls`);
    await page.waitForTimeout(250); // it may scroll smoothly
  }
  for (const key of ['w', 'u', 'd', 'b', '5']) await page.keyboard.press(key);
  await page.waitForTimeout(200);
  assert.doesNotMatch(page.url(), /layout=|[?&#][xyo]=/, page.url());
  await page.locator('.atlas-contents a', { hasText: 'HiZ' }).focus();
  await page.keyboard.press('Enter');
  await until(() => page.evaluate(() => document.activeElement.id), (id) => id === 'at-hiz', 'another method');
  await until(() => page.url(), (url) => url.includes('at=hiz'), 'in the address');

  const other = await openAtlas(`&figure=${kSweep}`);
  await other.page.locator('dialog[open] img').waitFor();
  assert.deepEqual([...complaints, ...other.complaints], []);
  await other.close();
  await close();
});

test('the single file has it, too', async () => {
  const { page, complaints, close } = await openPage(`${single}#page=atlas&figure=${kSweep}`);
  await until(() => page.locator('dialog[open] img').evaluateAll((images) => images.map((image) => image.naturalWidth).join()), (width) => Number(width) > 500, 'the curve');
  assert.deepEqual(complaints, []);
  await close();
});

for (const scheme of ['light', 'dark']) {
  test(`wide and narrow, axe-core finds nothing in the ${scheme} scheme, and nothing is cut off`, async () => {
    for (const width of [1400, 900, 420]) {
      const { page, complaints, close } = await openAtlas('&at=case:stability/29_the_cap_is_no_hit', { scheme, width });
      await page.locator('.atlas .shown').waitFor();
      assert.deepEqual(await findBarriers(page), [], String(width));
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} wide`);
      const cut = await page.locator('.atlas-table td').evaluateAll((cells) => cells.filter((cell) => cell.scrollWidth > cell.clientWidth + 1).map((cell) => cell.textContent));
      assert.deepEqual(cut, [], `${width} wide`);
      const filter = await page.locator('.chart-picture').first().evaluate((image) => getComputedStyle(image).filter);
      assert.equal(filter === 'none', scheme === 'light', 'charts on white are turned in the dark');
      assert.deepEqual(complaints, []);
      await close();
    }
  });
}
