import assert from 'node:assert/strict';
import { test } from 'node:test';
import { findTexel, viewDirection } from '../../harness/report/web/cubemap.js';

test('axes are the middles of their faces, in the order of the cube map table', () => {
  const axes = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
  axes.forEach((axis, face) => assert.deepEqual(findTexel(axis, 3), { face, x: 1, y: 1 }));
});

test('columns and rows run as the table says', () => {
  assert.deepEqual(findTexel([1, 0.9, -0.9], 4), { face: 0, x: 3, y: 0 });
  assert.deepEqual(findTexel([-1, 0.9, -0.9], 4), { face: 1, x: 0, y: 0 });
  assert.deepEqual(findTexel([0.9, 1, 0.9], 4), { face: 2, x: 3, y: 3 });
  assert.deepEqual(findTexel([0.9, -1, 0.9], 4), { face: 3, x: 3, y: 0 });
  assert.deepEqual(findTexel([0.9, 0.9, 1], 4), { face: 4, x: 3, y: 0 });
  assert.deepEqual(findTexel([0.9, 0.9, -1], 4), { face: 5, x: 0, y: 0 });
  assert.equal(findTexel([1, 1, 1], 4).face, 4);
  assert.equal(findTexel([1, 1, 0.5], 4).face, 2);
});

test('the view looks along -z, turns to the right and up', () => {
  const near = (a, b) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < 1e-12, `${a} is not ${b}`));
  near(viewDirection(0, 0, { yaw: 0, pitch: 0, fov: 90 }), [0, 0, -1]);
  near(viewDirection(1, 0, { yaw: 0, pitch: 0, fov: 90 }), [1, 0, -1]);
  near(viewDirection(0, 1, { yaw: 0, pitch: 0, fov: 90 }), [0, 1, -1]);
  near(viewDirection(0, 0, { yaw: 90, pitch: 0, fov: 90 }), [1, 0, 0]);
  near(viewDirection(0, 0, { yaw: 0, pitch: 90, fov: 90 }), [0, 1, 0]);
  near(viewDirection(1, 0, { yaw: 90, pitch: 0, fov: 90 }), [1, 0, 1]);
});
