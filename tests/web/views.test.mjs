import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { acceptCommand, knownFailureToml, quoteForShell, traceCommand } from '../../harness/report/web/commands.js';
import { choose } from '../../harness/report/web/choose.js';
import { divergingTable, nanColor, plusInfinityColor, sequentialTable } from '../../harness/report/web/colors.js';
import { compareDisplay, compareMask, countBeyond, decidableMask, measure, Plane, planesFromBytes, rankErrors, unpackFloats } from '../../harness/report/web/planes.js';
import { formatHash, kDefaults, parseHash } from '../../harness/report/web/state.js';
import { drawPlane, resolveView } from '../../harness/report/web/views.js';

const plane = (name, channels, values) => new Plane(name, values.length / channels, 1, channels, Float32Array.from(values));
const settings = { mode: 'auto', exposure: 0, offset: 0, gamma: -1, normalise: false, channel: -1 };
const pixels = (each, type, more = {}) => {
  const bytes = drawPlane(each, type, { ...resolveView({ ...settings, ...more }, type), range: { min: 0, max: 2 } });
  return Array.from({ length: each.pixels }, (_, i) => [...bytes.slice(i * 4, i * 4 + 3)]);
};
const luma = (table, i) => 0.2126 * table[i * 3] + 0.7152 * table[i * 3 + 1] + 0.0722 * table[i * 3 + 2];

test('floats come back bit by bit', async () => {
  const values = Float32Array.from([1, -0, NaN, Infinity, 1e-45]);
  const bytes = Buffer.from(values.buffer);
  const sorted = Buffer.alloc(bytes.length);
  for (let byte = 0; byte < 4; ++byte) for (let i = 0; i < 5; ++i) sorted[byte * 5 + i] = bytes[i * 4 + byte];
  const back = await unpackFloats(deflateSync(sorted).toString('base64'));
  assert.deepEqual(Buffer.from(back.buffer), bytes);
});

test('planes of a server are read as they lie', () => {
  const head = Buffer.from('{"width":2,"height":1,"planes":[{"name":"A","channels":1},{"name":"B","channels":2}]}  '.padEnd(88));
  const size = Buffer.alloc(4);
  size.writeUInt32LE(head.length);
  const values = Float32Array.from([1, -0, NaN, Infinity, 1e-45, 6]);
  const { buffer, byteOffset, length } = Buffer.concat([size, head, Buffer.from(values.buffer)]);
  const piece = planesFromBytes(buffer.slice(byteOffset, byteOffset + length));
  assert.deepEqual(piece.planes.map(({ name, channels, floats }) => [name, channels, ...floats]), [['A', 1, 1, -0], ['B', 2, NaN, Infinity, values[4], 6]]);
  assert.deepEqual([piece.width, piece.height], [2, 1]);
});

test('the sequential map grows lighter at every step, the diverging one darker both ways', () => {
  for (let i = 1; i < 256; ++i) assert.ok(luma(sequentialTable, i) > luma(sequentialTable, i - 1) - 0.6, String(i));
  assert.ok(luma(sequentialTable, 255) > 5 * luma(sequentialTable, 0));
  for (let i = 129; i < 256; ++i) assert.ok(luma(divergingTable, i) < luma(divergingTable, i - 1) + 0.6, String(i));
  assert.ok(Math.abs(luma(divergingTable, 0) - luma(divergingTable, 255)) < 25);
});

test('what is no number is loud in every view', () => {
  const odd = plane('Color', 3, [NaN, 0, 0, Infinity, 1, 1]);
  odd.data.set([NaN, 0, 0, Infinity, 1, 1].map((_, i) => [NaN, Infinity, 0, 1, 0, 1][i])); // channel after channel
  for (const mode of ['auto', 'color', 'map', 'signed', 'hdrp', 'class']) {
    assert.deepEqual(pixels(odd, 'color', { mode }), [nanColor, plusInfinityColor], mode);
  }
});

test('exposure, offset and channel', () => {
  const color = plane('Color', 3, [0.25, 0.5, 0.75]);
  const linear = { mode: 'color', gamma: 1 };
  assert.deepEqual(pixels(color, 'color', linear), [[64, 128, 191]]);
  assert.deepEqual(pixels(color, 'color', { ...linear, exposure: 1 }), [[128, 255, 255]]);
  assert.deepEqual(pixels(color, 'color', { ...linear, offset: 0.25 }), [[128, 191, 255]]);
  assert.deepEqual(pixels(color, 'color', { ...linear, channel: 1 }), [[128, 128, 128]]);
  assert.deepEqual(pixels(color, 'color', { ...linear, normalise: true }), [[32, 64, 96]]);
  assert.deepEqual(pixels(plane('Color', 3, [0.5, 0.5, 0.5]), 'color'), [[188, 188, 188]]);
});

test('the shader library\'s display encodings', () => {
  assert.deepEqual(pixels(plane('RayDirWS', 3, [0, 0, -1]), 'direction'), [[128, 128, 0]]);
  assert.deepEqual(pixels(plane('HitDepth', 1, [12.5]), 'depth', { mode: 'hdrp' }), [[64, 64, 64]]);
  assert.deepEqual(pixels(plane('HitSuccess', 1, [0, 1, 2, 3]), 'class', { mode: 'hdrp' }),
    [[0, 0, 0], [128, 255, 128], [128, 128, 255], [128, 128, 255]]);
});

test('statistics', () => {
  assert.deepEqual(measure(plane('X', 1, [1, -2, NaN, Infinity, -Infinity])), { min: -2, max: 1, nan: 1, plusInfinity: 1, minusInfinity: 1 });
  assert.equal(measure(plane('X', 1, [0, 2, 3]), -1, true).min, 2);
});

test('masks by expectation, narrowed by the backend\'s own hits', () => {
  const expected = [plane('HitDepth@1', 1, [1, 1, 1]), plane('mask@0,3', 1, [1, 0, 2])];
  assert.equal(compareMask(expected, 1, null), null);
  assert.deepEqual([...compareMask(expected, 3, plane('HitSuccess', 1, [0, 1, 1]))], [1, 0, 1]);
  assert.deepEqual([...compareMask(expected, 0, plane('HitSuccess', 1, [0, 1, 2]))], [1, 0, 0]);
});

test('errors, those beyond the bounds, and their rank', () => {
  const found = compareDisplay('depth', plane('a', 1, [1, 1, 1, 1]), plane('b', 1, [1, 2, 1.0001, NaN]), Uint8Array.of(1, 1, 1, 0), { floor: 0, relative: 0.01 });
  assert.deepEqual([...found.beyond], [0, 1, 0, 0]);
  assert.deepEqual(rankErrors(found.errors), [1, 2]);
});

test('what cannot be decided is counted apart', () => {
  assert.deepEqual(countBeyond(Uint8Array.of(1, 0, 1, 1), Uint8Array.of(1, 0, 0, 1)), { count: 2, excused: 1 });
  assert.deepEqual(countBeyond(Uint8Array.of(1, 0, 1, 1), null), { count: 3, excused: 0 });
});

test('the hash holds what differs from the start, and reads back', () => {
  assert.equal(formatHash(kDefaults), '#');
  const state = { ...kDefaults, case: 'hiz/a[x=1,y=2]&b</script>', ev: -2.5, x: 3, f: 's:failed "a b"' };
  assert.deepEqual(parseHash(formatHash(state)), state);
  assert.ok(formatHash(state).includes('case=hiz/a[x'));
  assert.deepEqual(parseHash('#x=abc&unknown=1&ev=2'), { ...kDefaults, ev: 2 });
});

test('commands survive a shell and TOML', () => {
  assert.equal(quoteForShell("it's"), "'it'\\''s'");
  assert.equal(traceCommand({ name: 'a[b=1]', file: 'mine/c.toml' }, 3, 4, ['x', 'y']), "crossray trace 'mine/c.toml[b=1]' --pixel 3,4 --backend x,y");
  assert.equal(traceCommand({ name: 'a', file: 'mine/c.toml' }, 3, 4, ['x'], true), 'crossray trace mine/c.toml --pixel 3,4 --backend x --json');
  assert.equal(acceptCommand('a', 'osmesa', 'out/last'), 'crossray review --run out/last --accept a --backend osmesa');
  assert.match(knownFailureToml(['osmesa'], 'a "b"\nc', '2026-01-31'), /reason {3}= "a \\"b\\""/);
});

test('an empty state becomes the failure that says most', () => {
  const item = { outputs: ['HitDepth'], results: [{ backend: 'a', tally: 'passed' }, { backend: 'b', tally: 'failed', output: 'HitDepth', expectation: 1 }] };
  const expectation = (index, source, passed) => ({ index, output: 'HitDepth', source, judged: true, comparison: { passed } });
  const details = { mustFail: false, backends: [{ backend: 'b', expectations: [expectation(0, 'constant', true), expectation(1, 'agree with a', false)] }] };
  const planesOf = new Map([['a', [plane('HitDepth', 1, [1])]], ['b', [plane('HitDepth', 1, [2])]], ['expected', [plane('HitDepth@0', 1, [2])]]]);
  const outputs = [{ name: 'HitDepth', type: 'depth', unit: 'm' }];
  const found = choose(kDefaults, item, details, planesOf, outputs);
  assert.equal(found.backend, 'b');
  assert.equal(found.expectation.index, 1);
  assert.equal(found.against.plane, planesOf.get('a')[0]);
  assert.equal(choose({ ...kDefaults, e: 0 }, item, details, planesOf, outputs).against.plane.name, 'HitDepth@0');
  assert.ok(choose({ ...kDefaults, vs: 'a' }, item, details, planesOf, outputs).isAgainstBackend);
});

test('pixels above the bound of conditioning cannot be decided', () => {
  const condition = new Plane('HitDepth@condition', 3, 1, 1, Float32Array.of(0, Infinity, 1025));
  assert.deepEqual([...decidableMask([condition], 'HitDepth', 1024)], [1, 0, 0]);
  assert.deepEqual([...decidableMask([condition], 'HitDepth', 2000)], [1, 0, 1]);
  assert.equal(decidableMask([condition], 'Color', 1024), null, 'not measured');
  assert.equal(decidableMask([new Plane('Color@condition', 2, 1, 1, Float32Array.of(0, 3))], 'Color', 1024), null, 'nowhere above');
  assert.equal(decidableMask(undefined, 'Color', 1024), null);
});
