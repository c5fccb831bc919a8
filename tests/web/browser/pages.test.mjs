// The pages beside a case's, and what axe-core says of each in both colour schemes.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { crossray, findBarriers, makeFaultyRun, openPage, repository, until, write } from './fixture.mjs';

let folder;
let report;

before(() => {
  folder = makeFaultyRun();
  const sweep = crossray(folder, 'sweep', 'floor/depth', 'camera.fov', '20..80:6', '--backend', 'cpu64,cpu32', '--json');
  assert.equal(sweep.code, 0, sweep.err);
  write(folder, 'sweep.json', sweep.out);
  // A room whose levels differ: a checkered wall.
  const room = readFileSync(join(repository, 'cases/capture/baked.toml'), 'utf8');
  write(folder, 'room/room.toml', room.replace('color = [0, 0.5, 0.5] }', 'pattern = "checker", cell_size = 0.7, color = [0, 0.5, 0.5] }'));
  const baked = crossray(folder, 'bake', 'room/room.toml', '-o', 'room.exr');
  assert.equal(baked.code, 0, baked.err);
  const made = crossray(folder, 'report', 'out/last', '--cubemap', 'room.exr',
    '--bench', join(repository, 'reports/published/bench_lavapipe.json'),
    '--bench', 'sweep.json');
  assert.equal(made.code, 0, made.err);
  report = join(folder, 'out/last/report/index.html');
});

test('a cubemap is turned, zoomed, brightened and shown at each level', async () => {
  const { page, complaints, close } = await openPage(`${report}#page=cubemaps`);
  const canvas = page.locator('#cubemaps canvas');
  await canvas.waitFor();
  const picture = () => canvas.evaluate((element) => element.toDataURL());
  const shown = new Set();
  const changed = async (what) => {
    const now = await until(picture, (data) => !shown.has(data), what);
    shown.add(now);
  };
  await changed('it is drawn');
  const box = await canvas.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 90, y + 20, { steps: 4 });
  await page.mouse.up();
  await changed('turned by the mouse');
  await page.mouse.wheel(0, 300);
  await changed('zoomed by the wheel');
  const slide = (name, value) => page.getByLabel(name).evaluate((input, to) => { input.value = to; input.dispatchEvent(new Event('input', { bubbles: true })); }, value);
  await slide('brightness', '3');
  await changed('brightened');
  await slide('mip level', '2');
  await changed('of another level');
  await canvas.focus();
  await page.keyboard.press('ArrowLeft');
  await changed('turned by a key');
  await page.mouse.move(x, y);
  await until(() => page.locator('#cubemaps').textContent(), (text) => /[+-][xyz] \(\d+, \d+\) of \d+ × \d+: \S+ {2}\S+ {2}\S+/.test(text), 'the texel under the mouse');
  await until(() => page.url(), (url) => /mip=2/.test(url) && /glow=3/.test(url) && /yaw=/.test(url), 'the view in the address');
  assert.deepEqual(complaints, []);
  await close();
});

for (const scheme of ['light', 'dark']) {
  test(`axe-core finds nothing in the ${scheme} scheme`, async () => {
    const views = ['#case=floor/depth&a=lavapipe', '#case=floor/depth&a=lavapipe&layout=slider', '#case=sky/class&f=s:failed', '#case=floor/direction&o=Color',
      '#page=cubemaps', '#page=charts'];
    for (const view of views) {
      const { page, complaints, close } = await openPage(report + view, { scheme });
      await page.locator(view.includes('page=') ? `${view.replace('#page=', '#')} h2` : '.pane canvas').first().waitFor();
      await page.waitForTimeout(150); // the trace comes by itself
      assert.deepEqual(await findBarriers(page), [], view);
      if (view === views[0]) {
        await page.keyboard.press('?');
        await page.locator('dialog[open]').waitFor();
        assert.deepEqual(await findBarriers(page), [], 'help');
      }
      assert.deepEqual(complaints, []);
      await close();
    }
    // The button changes the scheme, whatever the system's is.
    const { page, close } = await openPage(report, { scheme });
    await page.locator('.pane canvas').first().waitFor();
    const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const before = await ground();
    await page.locator('#theme').click();
    assert.notEqual(await ground(), before);
    assert.deepEqual(await findBarriers(page), []);
    await close();
  });
}
