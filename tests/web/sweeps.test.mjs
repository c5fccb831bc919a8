import assert from 'node:assert/strict';
import { test } from 'node:test';
import { linearAxis, logAxis } from '../../harness/report/web/svg.js';
import { classShares, errorLines, sweepOutputs } from '../../harness/report/web/sweeps.js';

const cell = (backend, max, classes) => ({ backend, errors: [{ output: 'HitDepth', max }, { output: 'HitDepth', max: 0.1 }], classes });
const sweep = {
  backends: ['cpu64', 'osmesa'],
  values: [
    { value: 1, backends: [cell('cpu64', 0.5, { hit: 0.75, 'miss: left the scene': 0.125, 'miss: iteration cap': 0.125 }), cell('osmesa', 'NaN', {})] },
    { value: 2, refused: 'no', backends: [] },
    { value: 3, backends: [cell('cpu64', 0, { unknown: 1 }), { backend: 'osmesa', failure: 'killed' }] },
  ],
};

test('a line has a gap where there was no answer', () => {
  assert.deepEqual(sweepOutputs(sweep), ['HitDepth']);
  const [first, second] = errorLines(sweep, 'HitDepth');
  assert.deepEqual(first.points, [[1, 0.5], [2, null], [3, 0.1]]);
  assert.deepEqual(second.points.map((point) => point[1]), [NaN, null, null]);
});

test('reasons of a class count together', () => {
  assert.deepEqual(classShares(sweep.values[0], 'cpu64'), { hit: 0.75, miss: 0.25, unknown: 0, 'no raycast': 0 });
});

test('axes keep their ends and order', () => {
  const even = linearAxis([2, 12], 100, 200);
  assert.equal(even.place(2), 100);
  assert.equal(even.place(12), 200);
  assert.deepEqual(even.ticks, [2, 4, 6, 8, 10, 12]);
  assert.equal(linearAxis([5, 5], 0, 10).place(5), 5);
  const log = logAxis([1e-6, 1], 300, 0);
  assert.ok(log.place(1e-6) > log.place(1) && log.ticks.length >= 6);
  assert.ok(Number.isFinite(logAxis([], 0, 1).place(1)));
});
