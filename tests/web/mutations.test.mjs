import assert from 'node:assert/strict';
import { test } from 'node:test';
import { formatScore, survivorsOf } from '../../harness/report/web/mutations.js';

test('a score is a share, or nothing', () => {
  assert.equal(formatScore(0.973), '97.3 %');
  assert.equal(formatScore(1), '100.0 %');
  assert.equal(formatScore(null), '–');
});

test('files with the most survivors come first', () => {
  const mutants = [['a', 3, 'survived'], ['b', 9, 'survived'], ['b', 2, 'survived'], ['c', 1, 'caught']]
    .map(([file, line, end]) => ({ file, line, end }));
  assert.deepEqual(survivorsOf({ mutants }).map(({ file, line }) => [file, line]), [['b', 2], ['b', 9], ['a', 3]]);
});
