// What `run --conditioning` measured, as the page shows it: undecidable pixels are hatched, and no others.
import assert from 'node:assert/strict';
import { cpSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { clickPixel, crossray, makeFolder, openPage, readExrPart, repository, until } from './fixture.mjs';

const kSize = 16;
const kBound = 1024; // ulp of output for one of input
const kRing = 12;
let folder;
let report;

before(() => {
  folder = makeFolder();
  for (const name of ['undecidable_silhouette', 'undecidable_critical_angle']) cpSync(join(repository, `cases/stability/${name}.toml`), join(folder, `cases/stability/${name}.toml`));
  cpSync(join(repository, 'cases/presets.toml'), join(folder, 'cases/presets.toml'));
  const run = crossray(folder, 'run', '--conditioning', '--backend', 'lavapipe,cpu32,cpu64', '--planes', 'all', '--progress', 'none', '-j2');
  assert.equal(run.code, 0, run.out + run.err);
  report = join(folder, 'out/last/report/index.html');
});

/** The colours of a pane's canvas inside each pixel of the image, by rows. */
const readPixels = (page, pane) => page.locator(`.pane.${pane} canvas`).evaluate((canvas, size) => {
  const ratio = devicePixelRatio;
  const zoom = Math.min(canvas.clientWidth, canvas.clientHeight) / size;
  const [left, top] = [canvas.clientWidth / 2 - (size / 2) * zoom, canvas.clientHeight / 2 - (size / 2) * zoom];
  const context = canvas.getContext('2d');
  const side = Math.floor(zoom * ratio) - 4; // without the borders that two pixels share
  return Array.from({ length: size * size }, (_, i) => {
    const [x, y] = [i % size, Math.floor(i / size)];
    return context.getImageData(Math.ceil((left + x * zoom) * ratio) + 2, Math.ceil((top + y * zoom) * ratio) + 2, side, side).data.join();
  });
}, kSize);

for (const [name, output] of [['undecidable_silhouette', 'HitDepth'], ['undecidable_critical_angle', 'RayDirWS']]) {
  test(`the pixels of ${name} that a run found undecidable are hatched, and no others`, async () => {
    const condition = readExrPart(join(folder, `out/last/planes/stability/${name}/conditioning.exr`), `${output}@condition`);
    const isUndecidable = Array.from({ length: kSize * kSize }, (_, i) => condition.at(i % kSize, Math.floor(i / kSize)) > kBound);
    assert.equal(isUndecidable.filter(Boolean).length, kRing);

    // The pixel's square stands in the corner, away from the ring.
    const { page, complaints, close } = await openPage(`${report}#case=stability/${name}&a=cpu32&o=${output}&x=0&y=0&worst=0`);
    await page.locator('.pane.difference canvas').waitFor();
    const hatch = page.getByLabel('hatch');
    for (const pane of ['against', 'actual', 'difference']) {
      await hatch.check();
      const read = () => readPixels(page, pane);
      const isFlat = (pixels) => pixels.every((pixel) => /^((?:\d+,){3}\d+)(,\1)*$/.test(pixel));
      const hatched = await until(read, (pixels) => pixels.some((pixel) => pixel.includes(',255')) && !isFlat(pixels.slice(1)), `${pane} is hatched`);
      await hatch.uncheck();
      const plain = await until(read, (pixels) => isFlat(pixels.slice(1)), `${pane} is plain`);
      for (let i = 1; i < hatched.length; ++i) {
        assert.equal(hatched[i] !== plain[i], isUndecidable[i], `${pane}: pixel ${i % kSize}, ${Math.floor(i / kSize)}`);
      }
    }
    await hatch.check();

    // The head counts them as the judge does, and the pixel's panel says why.
    assert.match(await page.locator('.facts-line').textContent(), /^0 of 256 px beyond/);
    assert.match(await page.locator('.pane.difference .facts').textContent(), /^0 px beyond · \d+ undecidable · /);
    const at = isUndecidable.indexOf(true);
    await clickPixel(page, 'actual', at % kSize, Math.floor(at / kSize), kSize, kSize);
    const said = () => page.locator('#pixel').textContent();
    await until(said, (text) => /undecidable here: .* for an ulp of/.test(text), 'the pixel is said to be undecidable');
    await clickPixel(page, 'actual', 0, 0, kSize, kSize);
    await until(said, (text) => !text.includes('undecidable here'), 'another is not');
    assert.deepEqual(complaints, []);
    await close();
  });
}
