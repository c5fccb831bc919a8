import assert from 'node:assert/strict';
import { test } from 'node:test';
import { filterCase, parseFilter } from '../../harness/report/web/filter.js';
import { failureKey, groupCases } from '../../harness/report/web/list.js';

const result = (backend, verdict, tally, more = {}) => ({ backend, verdict, tally, ...more });
const item = {
  name: 'hiz/two_planes[ior=1.2]', summary: 'Two planes meet.', tags: ['hiz', 'slow'], outputs: ['HitDepth', 'HitSuccess'],
  results: [result('osmesa', 'fail', 'failed'), result('cpu64', 'pass', 'passed'), result('lavapipe', 'known-fail', 'skipped')],
};
const left = (text) => filterCase(parseFilter(text), item)?.map((each) => each.backend) ?? null;

test('each kind of word', () => {
  assert.deepEqual(left(''), ['osmesa', 'cpu64', 'lavapipe']);
  assert.deepEqual(left('s:failed'), ['osmesa']);
  assert.deepEqual(left('s:known'), ['lavapipe']);
  assert.deepEqual(left('b:CPU'), ['cpu64']);
  assert.equal(left('o:HitDepth').length, 3);
  assert.equal(left('o:Color'), null);
  assert.equal(left('@hiz').length, 3);
  assert.equal(left('@probe'), null);
  assert.equal(left('two_planes').length, 3);
  assert.equal(left('"planes meet"').length, 3);
  assert.equal(left('"meet planes"'), null);
});

test('words are joined, and a verdict is of the backend beside it', () => {
  assert.deepEqual(left('s:failed b:osmesa o:hitd @hiz "two planes"'), ['osmesa']);
  assert.equal(left('s:failed b:cpu64'), null);
});

test('not', () => {
  assert.equal(left('!@slow'), null);
  assert.equal(left('!meet'), null);
  assert.deepEqual(left('!s:failed'), ['cpu64', 'lavapipe']);
  assert.deepEqual(left('s:failed !b:osmesa'), null);
  assert.equal(left('!"one plane"').length, 3);
});

test('what is still being typed filters nothing', () => {
  for (const text of ['s:', 'b:', '@', '!', '"', '!@']) assert.equal(left(text)?.length, 3, text);
  assert.equal(left('"planes me').length, 3);
});

test('equal failures stand together, the largest group first, the rest by folder', () => {
  const failed = (name, output) => ({ ...item, name, results: [result('osmesa', 'fail', 'failed', { output, kind: 'NaN for finite' })] });
  const cases = [failed('a/one', 'Color'), failed('b/two', 'HitDepth'), failed('c/three', 'HitDepth'),
    { ...item, name: 'd/four', results: [result('osmesa', 'pass', 'passed')] }];
  const groups = groupCases(cases, '');
  assert.deepEqual(groups.map((group) => [group.title, group.items.length, group.failed]),
    [['HitDepth: NaN for finite', 2, true], ['Color: NaN for finite', 1, true], ['d', 1, false]]);
  assert.equal(groupCases(cases, 'o:Confidence').length, 0);
});

test('numbers do not part failures that say the same', () => {
  const key = (reason) => failureKey(result('osmesa', 'crash', 'failed', { reason }));
  assert.equal(key('killed by signal 11 after 0.5 s'), key('killed by signal 6 after 12 s'));
  assert.notEqual(key('killed by signal 11'), key('no memory'));
});
