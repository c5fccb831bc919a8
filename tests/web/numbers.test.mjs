import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
  angleDegrees, floatHex, formatFloat, formatShort, isWithin, parseTolerance, pixelError, ulpDistance,
} from '../../harness/report/web/numbers.js';

test('bits', () => {
  assert.equal(floatHex(1), '0x3f800000');
  assert.equal(floatHex(-0), '0x80000000');
  assert.equal(floatHex(NaN), '0x7fc00000');
});

test('the shortest text that is the same float', () => {
  assert.equal(formatFloat(Math.fround(0.1)), '0.1');
  assert.equal(formatFloat(Math.fround(1 / 3)), '0.33333334');
  assert.equal(formatFloat(16777216), '16777216');
  assert.equal(formatFloat(-0), '-0');
  assert.equal(formatFloat(NaN), 'NaN');
  assert.equal(formatFloat(-Infinity), '-Inf');
  for (const value of [1e-45, 3.4028234663852886e38, 1.17549435e-38, 6.5504e4, -2.5e-7]) {
    assert.equal(Math.fround(Number(formatFloat(Math.fround(value)))), Math.fround(value));
  }
});

test('a few digits', () => {
  assert.equal(formatShort(0.000012345), '1.234e-5');
  assert.equal(formatShort(1e-7), '1e-7');
  assert.equal(formatShort(1234567), '1.235e6');
  assert.equal(formatShort(0.75124), '0.7512');
  assert.equal(formatShort('NaN'), 'NaN');
});

test('units in the last place', () => {
  assert.equal(ulpDistance(1, Math.fround(1 + 2 ** -23)), 1);
  assert.equal(ulpDistance(0, -0), 0);
  assert.equal(ulpDistance(2 ** -149, -(2 ** -149)), 2);
  assert.equal(ulpDistance(NaN, 1), Infinity);
});

test('angles keep their digits', () => {
  assert.ok(Math.abs(angleDegrees([0, 0, -1], [1e-9, 0, -1]) - 1e-9 * 180 / Math.PI) < 1e-18);
  assert.equal(angleDegrees([0, 0, 1], [0, 0, -1]), 180);
});

test('errors by type', () => {
  assert.equal(pixelError('depth', [2], [3]), 0.5);
  assert.equal(pixelError('depth', [0], [1]), Infinity);
  assert.equal(pixelError('color', [1, 2, 3], [1, 2.5, 3]), 0.5);
  assert.equal(pixelError('color', [1, 2, 3], [1, NaN, 3]), Infinity);
  assert.equal(pixelError('class', [1], [2]), 1);
  assert.equal(pixelError('direction', [0, 0, 0], [0, 0, 0]), 0);
  assert.equal(pixelError('direction', [0, 0, 1], [0, 0, 0]), Infinity);
  assert.equal(pixelError('direction', [0, 0, 1], [0.6, 0, 0]), Infinity);
});

test('tolerances in run.json\'s words', () => {
  assert.deepEqual(parseTolerance('0.0001 relative or 4 ulp, below 1e-07 zero; 1 % may be off by up to 0.5'),
    { floor: 1e-7, relative: 1e-4, ulp: 4 });
  assert.deepEqual(parseTolerance('exact'), { floor: 0 });
  assert.equal(parseTolerance('4 ulp of a double'), null);
  assert.equal(parseTolerance('recall >= 0.9999, precision >= 0.985, false <= 0 within 2 px'), null);
  const bounds = parseTolerance('0.001 relative or 1e-05 absolute');
  assert.ok(isWithin('depth', [1], [1.0009], bounds));
  assert.ok(!isWithin('depth', [1], [1.0011], bounds));
  assert.ok(isWithin('depth', [0], [1e-5], bounds));
  assert.ok(!isWithin('depth', [1], [NaN], bounds));
  assert.ok(isWithin('class', [1], [1], { floor: 0 }));
  assert.ok(!isWithin('class', [1], [2], { floor: 0 }));
});
