// How long 300 cases take to become pages, and those to show themselves.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { caseOf, crossray, makeFolder, openPage, write } from './fixture.mjs';

test('300 cases with 10 failures: a folder in under 3 s, a first paint in under 1 s', async (t) => {
  const folder = makeFolder();
  const fovs = (count) => Array.from({ length: count }, (_, i) => 40 + i / 16).join(', ');
  const holds = '[[expect]]\noutput = "HitSuccess"\nagree = ["lavapipe", "cpu32", "cpu64"]\ntolerance = { outliers = 0.02, worst = 1 }\n';
  const fails = '[[expect]]\noutput = "HitSuccess"\nconstant = "hit"\nwhere = "all"\n';
  write(folder, 'cases/holds.toml', `${caseOf('many/hold', 'All agree.', holds)}\n[expand]\ncamera.fov = [${fovs(290)}]\n`);
  write(folder, 'cases/fails.toml', `${caseOf('few/fail', 'Every ray meets something.', fails)}\n[expand]\ncamera.fov = [${fovs(10)}]\n`);
  const run = crossray(folder, 'run', '--backend', 'lavapipe,cpu32,cpu64', '--no-report', '--progress', 'none', '-j2');
  assert.match(run.out, /870 passed, 30 failed, 0 skipped/, run.out.slice(-400) + run.err);

  const start = performance.now();
  const made = crossray(folder, 'report', 'out/last');
  const seconds = (performance.now() - start) / 1000;
  assert.equal(made.code, 0, made.err);

  const { page, complaints, close } = await openPage(join(folder, 'out/last/report/index.html'));
  await page.locator('.pane.actual canvas').waitFor();
  const paint = await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0].startTime);
  t.diagnostic(`folder ${seconds.toFixed(2)} s, first paint ${paint.toFixed(0)} ms`);
  assert.equal(await page.locator('[role=option]').count(), 300);
  assert.ok(seconds < 3, `the folder took ${seconds} s`);
  assert.ok(paint < 1000, `the first paint came after ${paint} ms`);
  assert.deepEqual(complaints, []);
  await close();
});
