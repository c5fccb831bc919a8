// What the tests of the pages share: runs of the built crossray, a browser, and what is read from planes without the pages.
import { spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';

const build = resolve(process.env.CROSSRAY_BUILD ?? 'build');
const require = createRequire(join(build, 'browser', 'package.json'));
const { chromium } = require('playwright-core');
const axeSource = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');

export const repository = fileURLToPath(new URL('../../../', import.meta.url));
export const program = join(build, 'crossray');

let browser;
const folders = [];
after(async () => {
  await browser?.close();
  for (const folder of folders) rmSync(folder, { recursive: true, force: true });
});

/** A folder that goes when the tests end. */
export function makeFolder() {
  folders.push(mkdtempSync(join(tmpdir(), 'crossray_pages_')));
  return folders.at(-1);
}

/** Writes a file below a folder. */
export function write(folder, name, content) {
  mkdirSync(dirname(join(folder, name)), { recursive: true });
  writeFileSync(join(folder, name), content);
}

/** Runs crossray there; compiled shaders go to the build folder, so that the tests warm each other. */
export function crossray(folder, ...words) {
  const done = spawnSync(program, words, { cwd: folder, encoding: 'utf8', env: environment(folder), maxBuffer: 1 << 26 });
  return { code: done.status, out: done.stdout, err: done.stderr };
}

/** Of programs that run in such a folder. */
export function environment(folder) {
  return { ...process.env, CROSSRAY_CASES: join(folder, 'cases'), CROSSRAY_CACHE: join(build, 'browser', 'cache') };
}

/** A mirror floor before a wall: every pixel below the horizon traces a ray through the depth pyramid. */
export function caseOf(name, summary, more) {
  return `schema  = 1
name    = "${name}"
summary = "${summary}"
tags    = ["floor"]
outputs = ["HitDepth", "HitSuccess", "RayDirWS", "Color", "IterationCount"]

[camera]
eye    = [0, 1.5, 3]
target = [0, 0.5, -2]

[scene]
size       = [48, 36]
primitives = [
    { shape = "plane", normal = [0, 1, 0], half_extents = [4, 4], material = "mirror" },
    { shape = "plane", center = [0, 0, -4], half_extents = [50, 50], pattern = "gradient", color = [0, 0.25, 0.5], color_b = [1, 0.5, 0.25] },
]

[projection]
model     = "hiz"
min_level = 0
max_level = 6
${more}`;
}

/** An expectation that such a case meets. */
export const kDepthIsTrue = `
[[expect]]
output    = "HitDepth"
truth     = "hit_depth"
tolerance = { relative = 1e-3 }
where     = "answerable_hits"
`;

export const kPixelOfNaN = [20, 30];

/**
 * A run on lavapipe, cpu64 and cpu32 of cases under a copy of the shaders with a fault in it: a depth 0.1 % too far
 * after ten steps, and a NaN. The processors' code is compiled ahead, so lavapipe alone is wrong.
 */
export function makeFaultyRun() {
  const folder = makeFolder();
  write(folder, 'cases/floor/depth.toml', caseOf('floor/depth', 'The depth of a hit is that of the wall.', `
[[expect]]
output    = "HitDepth"
truth     = "hit_depth"
tolerance = { relative = 5e-4 }
where     = "answerable_hits"

[[expect]]
output    = "HitSuccess"
agree     = ["lavapipe", "cpu32", "cpu64"]
tolerance = { outliers = 0.01, worst = 1 }
`));
  write(folder, 'cases/floor/direction.toml', caseOf('floor/direction', 'A mirror reflects.', `
[[expect]]
output    = "RayDirWS"
truth     = "ray_direction"
tolerance = { degrees = 1e-3 }
`).replace('["floor"]', '["floor", "mirror"]'));
  write(folder, 'cases/sky/class.toml', caseOf('sky/class', 'Every ray meets something, which is false.', `
[[expect]]
output   = "HitSuccess"
constant = "hit"
where    = "all"
`));
  cpSync(join(repository, 'shaders'), join(folder, 'shaders'), { recursive: true });
  const file = join(folder, 'shaders/pass/store_outputs.glsl');
  const depth = 'vec4(answer.linearDepth, 0.0, 0.0, 0.0)';
  const text = readFileSync(file, 'utf8');
  if (!text.includes(depth)) throw new Error(`${file} no longer stores the depth as the fault expects`);
  const [x, y] = kPixelOfNaN;
  writeFileSync(file, text.replace(depth, `vec4(pixel == ivec2(${x}, ${y}) ? uintBitsToFloat(0x7fc00000u)`
    + ' : answer.iterations > 10 ? answer.linearDepth * 1.001 : answer.linearDepth, 0.0, 0.0, 0.0)'));
  const run = crossray(folder, '--shaders', 'shaders', 'run', '--backend', 'lavapipe,cpu32,cpu64', '--planes', 'all', '--progress', 'none', '-j2');
  if (run.code !== 1) throw new Error(`the run ended with ${run.code}\n${run.out}${run.err}`);
  return folder;
}

// A header of attributes: name, type, size, bytes; an empty name ends it.
function readHeader(bytes, at) {
  const word = () => { const end = bytes.indexOf(0, at); const text = bytes.toString('latin1', at, end); at = end + 1; return text; };
  const header = {};
  for (let name = word(); name !== ''; name = word()) {
    word();
    const size = bytes.readInt32LE(at);
    header[name] = bytes.subarray(at + 4, at + 4 + size);
    at += 4 + size;
  }
  return { header, at };
}

/** The floats of a one-channel part of an uncompressed EXR, straight from its bytes. */
export function readExrPart(file, part) {
  const bytes = readFileSync(file);
  const parts = [];
  let at = 8;
  for (;;) {
    const read = readHeader(bytes, at);
    at = read.at;
    if (Object.keys(read.header).length === 0) break;
    parts.push(read.header);
  }
  const nameOf = (header) => header.name.toString('latin1');
  const index = parts.findIndex((header) => nameOf(header) === part);
  if (index < 0) throw new Error(`${file} has ${parts.map(nameOf)} and no ${part}`);
  const rows = (header) => header.dataWindow.readInt32LE(12) - header.dataWindow.readInt32LE(4) + 1;
  for (let i = 0; i < index; ++i) at += 8 * rows(parts[i]);
  const height = rows(parts[index]);
  const width = parts[index].dataWindow.readInt32LE(8) - parts[index].dataWindow.readInt32LE(0) + 1;
  if (parts[index].compression[0] !== 0) throw new Error(`${file} is compressed`);
  return {
    width, height,
    at: (x, y) => bytes.readFloatLE(Number(bytes.readBigUInt64LE(at + 8 * y)) + 12 + 4 * x), // part, row and size before it
  };
}

/** A page of its own, and what its console said that it should not. `prepare(page)` is called before it opens its address. */
export async function openPage(target, { scheme = 'light', width = 1400, height = 900, prepare = () => {} } = {}) {
  browser ??= await chromium.launch({ executablePath: process.env.CROSSRAY_CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu'] });
  const context = await browser.newContext({ colorScheme: scheme, viewport: { width, height } });
  const page = await context.newPage();
  const complaints = [];
  // One warning is about the tests' own reading of colours.
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && !message.text().includes('willReadFrequently') && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.setDefaultTimeout(15000);
  await prepare(page);
  await page.goto(target.includes('://') ? target : pathToFileURL(target.split('#')[0]).href + (target.includes('#') ? target.slice(target.indexOf('#')) : ''));
  return { page, complaints, close: () => context.close() };
}

/** What axe-core finds, one line each. */
export async function findBarriers(page) {
  await page.evaluate(axeSource);
  const { violations } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ['violations'] }));
  return violations.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.target.join(' ')}: ${node.failureSummary.split('\n').slice(1).join(' ')}`));
}

/** Clicks the middle of an image's pixel in a pane. */
export async function clickPixel(page, pane, x, y, width, height) {
  const place = await placeOfPixel(page, pane, x, y, width, height);
  await page.mouse.click(...place);
}

/** Where the middle of an image's pixel is in the window, when the picture is fitted into its pane. */
export async function placeOfPixel(page, pane, x, y, width, height) {
  const box = await page.locator(`.pane.${pane} canvas`).boundingBox();
  const zoom = Math.min(box.width / width, box.height / height);
  return [box.x + box.width / 2 + (x + 0.5 - width / 2) * zoom, box.y + box.height / 2 + (y + 0.5 - height / 2) * zoom];
}

/** The colour of a pane's canvas there, 0 to 255 each. */
export async function colorAt(page, pane, [left, top]) {
  return page.locator(`.pane.${pane} canvas`).evaluate((canvas, [x, y]) => {
    const box = canvas.getBoundingClientRect();
    return [...canvas.getContext('2d').getImageData(Math.round((x - box.left) * devicePixelRatio), Math.round((y - box.top) * devicePixelRatio), 1, 1).data.slice(0, 3)];
  }, [left, top]);
}

/** Waits until `read()` gives what `fits`; the last value in the complaint. */
export async function until(read, fits, what) {
  let value;
  for (let i = 0; i < 800; ++i) {
    value = await read();
    if (fits(value)) return value;
    await new Promise((done) => setTimeout(done, 25));
  }
  throw new Error(`${what}: still ${JSON.stringify(value)?.slice(0, 400)}`);
}
