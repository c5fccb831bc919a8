import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clampValue, counts, formatParameters, parametersOf, parseParameters, sliderRange, valueOf } from '../../harness/report/web/parameters.js';

test('changed parameters go into the address and come back', () => {
  const values = { 'material.ior': '1.7', 'projection.model': 'hiz', 'camera.eye.0': '-2' };
  assert.equal(formatParameters(values), 'material.ior=1.7;projection.model=hiz;camera.eye.0=-2');
  assert.deepEqual(parseParameters(formatParameters(values)), values);
  assert.deepEqual(parseParameters(''), {});
  assert.deepEqual(parseParameters('=3;x;a=1'), { a: '1' });
});

test('a request carries them by the types of the controls that the case has', () => {
  const controls = [{ path: 'a', type: 'number' }, { path: 'b', type: 'integer' }, { path: 'c', type: 'boolean' }, { path: 'd', type: 'choice', choices: ['x', 'y'] }];
  assert.deepEqual(parametersOf(controls, 'a=1.5;b=3.4;c=false;d=y;e=9'), { a: 1.5, b: 3, c: false, d: 'y' });
  assert.deepEqual(parametersOf(controls, 'a=one;b=;c=1;d=z'), {});
  assert.equal(valueOf(controls[0], ' '), undefined);
});

test('values stay within their bounds, a bound that is out itself is missed', () => {
  const ior = { type: 'number', minimum: 0, exclusiveMinimum: true, maximum: 10 };
  assert.ok(clampValue(ior, -1) > 0);
  assert.equal(clampValue(ior, 11), 10);
  assert.equal(clampValue({ type: 'integer', minimum: 0, exclusiveMinimum: true }, 0), 1);
  assert.equal(clampValue({ type: 'number' }, -1e9), -1e9);
});

test('a slider spans what is allowed, or what lies around the own value of the case', () => {
  assert.deepEqual(sliderRange({ type: 'number', minimum: 0, maximum: 2, value: 0 }), { min: 0, max: 2, step: 0.01 });
  assert.deepEqual(sliderRange({ type: 'integer', minimum: 0, maximum: 16, value: 2 }), { min: 0, max: 16, step: 1 });
  assert.deepEqual(sliderRange({ type: 'number', minimum: 0, maximum: 10000, value: 5 }), { min: 0, max: 15, step: 0.1 });
  assert.deepEqual(sliderRange({ type: 'number', value: -3 }), { min: -9, max: 3, step: 0.1 });
  assert.ok(sliderRange({ type: 'number', minimum: 0, exclusiveMinimum: true, maximum: 10, value: 1.5 }).min > 0);
  assert.deepEqual(sliderRange({ type: 'number', value: null, default: null }), { min: -2, max: 2, step: 0.02 });
});

test('a control counts only where another has a value that asks for it', () => {
  const control = { when: { path: 'model', values: ['patches'] } };
  assert.equal(counts(control, () => 'patches'), true);
  assert.equal(counts(control, () => 'hiz'), false);
  assert.equal(counts({}, () => 'hiz'), true);
});
