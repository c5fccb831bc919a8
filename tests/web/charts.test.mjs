import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { paretoFront, readCharts } from '../../harness/report/web/charts.js';

const published = (name) => JSON.parse(readFileSync(new URL(`../../reports/published/${name}`, import.meta.url)));

test('the front is what nothing beats', () => {
  const front = paretoFront([{ cost: 1, error: 5 }, { cost: 2, error: 5 }, { cost: 2, error: 1 }, { cost: 9, error: 1 }, { cost: 2, error: 1 }]);
  assert.deepEqual(front, [true, false, true, false, true]);
  assert.deepEqual(paretoFront([{ cost: 1, error: 0, isBound: true }, { cost: 2, error: 1 }]), [false, true]);
});

test('the published benches are charts', () => {
  const file = published('bench_lavapipe.json');
  const bench = readCharts(file);
  assert.deepEqual(bench.map((chart) => chart.caseName), file.scenes.map((scene) => scene.case));
  assert.equal(bench[0].caseName, bench[0].title);
  assert.ok(bench.every((chart) => chart.points.every((point) => point.kind && Object.keys(point.errors).length > 0)));
  const [tracers] = readCharts(published('tracers_rooms_360.json'));
  assert.ok(tracers.points.length > 3);
  assert.ok(tracers.points.every((point) => point.costs.Fetches >= 0 && point.errors.Missed >= -1e-9));
  assert.ok(tracers.reliability.length > 0);
  assert.equal(tracers.points.filter((point) => point.isBound).length, 1);
});
