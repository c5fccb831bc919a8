// Puts the page together: state changes in, drawings out.
import { drawAtlas } from 'crossray/atlas.js';
import { drawCharts } from 'crossray/charts.js';
import { choose } from 'crossray/choose.js';
import { drawCubemaps } from 'crossray/cubemap.js';
import { forgetPieces, loadDetails, loadPlanes, readIndex } from 'crossray/data.js';
import { h, say } from 'crossray/dom.js';
import { drawCommands, drawHead, figuresTable } from 'crossray/head.js';
import { listenToKeys, openHelp } from 'crossray/keys.js';
import { createList } from 'crossray/list.js';
import { createLive } from 'crossray/live.js';
import { formatShort, parseTolerance, unitOf } from 'crossray/numbers.js';
import { createPanes } from 'crossray/panes.js';
import { drawPixel } from 'crossray/pixel.js';
import { compareDisplay, compareMask, countBeyond, decidableMask, measure, rankErrors } from 'crossray/planes.js';
import { drawRecord } from 'crossray/record.js';
import { openRun } from 'crossray/run_facts.js';
import { createStore } from 'crossray/state.js';
import { drawToolbar } from 'crossray/toolbar.js';
import { addTrace, drawTracePanel, findTrace } from 'crossray/trace.js';
import { drawDifference, drawPlane, resolveView } from 'crossray/views.js';

const kSchema = 'crossray-report/1';
const byId = (id) => document.getElementById(id);
const index = readIndex();
const kPages = { charts: drawCharts, cubemaps: drawCubemaps, atlas: drawAtlas }; // beside that of a case
const pages = [index.benches.length > 0 && 'charts', index.cubemaps.length > 0 && 'cubemaps', index.atlas && 'atlas'];
const cases = new Map(index.cases.map((item) => [item.name, item]));

// What is loaded of the chosen case, and what choose() made of it.
let model = { item: null, details: null, planesOf: new Map() };
let shown = null;
let picture = { mask: null, errors: null, rank: [] };
let trace = null;
let drawnTrace = []; // what the panel of the trace was last drawn from

const store = createStore(react);
const state = () => store.get();
const update = (patch) => store.update(patch);
const list = createList(index.cases, (name) => goToCase(name));
const panes = createPanes(byId('panes'), { state, update, pick: (x, y) => update({ x, y }) });
const live = index.live ? createLive(index, { state, update, showItem, showTrace: () => drawTraceOfPixel(), added: addCase }) : null;

function goToCase(name) {
  if (name) update({ page: '', p: '', case: name, a: '', o: '', e: -1, x: -1, y: -1, vs: 'expected', step: -1, z: 0, cx: 0.5, cy: 0.5 });
}

async function loadModel(item) {
  const sources = Object.keys(item.planes ?? {});
  const [details, ...planes] = await Promise.all([loadDetails(item), ...sources.map((source) => loadPlanes(item, source))]);
  return { item, details, planesOf: new Map(sources.map((source, i) => [source, planes[i]])) };
}

async function loadCase(item) {
  const loading = { item, details: null, planesOf: new Map() };
  model = loading;
  list.select(item.name);
  drawAll();
  if (live) return void live.open(item);
  try {
    Object.assign(loading, await loadModel(item));
  } catch (error) {
    say(error.message);
  }
  if (loading === model) drawAll();
}

// A new rendering of a case: it takes the place of the old one when all of it is there.
async function showItem(item) {
  const next = await loadModel(item);
  if (state().case !== item.name) return;
  forgetPieces(model.item);
  const old = cases.get(item.name);
  cases.set(item.name, item);
  index.cases[index.cases.indexOf(old)] = item;
  model = next;
  if (JSON.stringify(old.results) !== JSON.stringify(item.results)) {
    list.draw(state().f);
    list.select(item.name, false);
  }
  drawAll();
}

// A case that was saved just now.
function addCase(item) {
  if (cases.has(item.name)) return;
  cases.set(item.name, item);
  index.cases.push(item);
  list.draw(state().f);
  list.select(state().case, false);
}

// The pixel to look at: the one asked for, else the worst that the judge found, else the largest difference.
function currentPixel() {
  const plane = shown?.actual?.plane ?? shown?.expected?.plane;
  if (!plane) return [-1, -1];
  const { x, y } = state();
  if (x >= 0 && y >= 0 && x < plane.width && y < plane.height) return [x, y];
  const worst = worstPixel();
  return worst ?? [Math.floor(plane.width / 2), Math.floor(plane.height / 2)];
}

function worstPixel() {
  const worst = !shown.isAgainstBackend && shown.expectation?.comparison?.worst;
  if (worst) return [worst.x, worst.y];
  const plane = shown.actual?.plane;
  return picture.rank.length > 0 && plane ? [picture.rank[0] % plane.width, Math.floor(picture.rank[0] / plane.width)] : null;
}

function rangeOf(planes, channel) {
  const found = planes.map((plane) => measure(plane, channel, shown.type === 'depth'));
  return { min: Math.min(...found.map((each) => each.min)), max: Math.max(...found.map((each) => each.max)) };
}

function factsOf(plane) {
  const { min, max, nan, plusInfinity, minusInfinity } = measure(plane, state().ch < plane.channels ? state().ch : -1, shown.type === 'depth');
  const loud = [[nan, 'NaN'], [plusInfinity, '+Inf'], [minusInfinity, '−Inf']].filter(([count]) => count > 0);
  return {
    facts: [`${formatShort(min)} … ${formatShort(max)}`, ...loud.map(([count, name]) => `${count} ${name}`)].join(' · '),
    isLoud: loud.length > 0,
  };
}

function planePane(key, { plane, title }, view, mask) {
  return { key, title, width: plane.width, height: plane.height, bytes: drawPlane(plane, shown.type, view), mask, decidable: picture.decidable, ...factsOf(plane) };
}

function differencePane() {
  const { against, actual } = shown;
  const finite = picture.errors.filter(Number.isFinite);
  const largest = finite.reduce((a, b) => Math.max(a, b), 0);
  const endless = picture.errors.length - finite.length;
  const { dx, signed, ch } = state();
  const facts = [`${picture.count} px ${picture.isJudged ? 'beyond' : 'differ'}`, ...(picture.excused > 0 ? [`${picture.excused} undecidable`] : []), `max ${formatShort(largest)} ${unitOf(shown.type)}`];
  if (endless > 0) facts.push(`${endless} without a number`);
  return {
    key: 'difference', title: signed ? 'actual − expected' : 'difference', width: actual.plane.width, height: actual.plane.height,
    bytes: drawDifference(against.plane, actual.plane, picture, picture.mask, { multiplier: dx, signed: signed === 1, channel: ch, largest }),
    mask: picture.mask, decidable: picture.decidable, facts: facts.join(' · '), isLoud: endless > 0,
  };
}

const undecidableAbove = () => shown.expectation?.undecidableAbove ?? model.details?.conditioning?.bound ?? 1024;

// Everything that depends on what is compared and not on how it is shown.
function comparePlanes() {
  const { against, actual, expectation } = shown;
  const decidable = decidableMask(model.planesOf.get('conditioning'), shown.output, undecidableAbove());
  const found = { shown, decidable, mask: null, errors: null, rank: [], count: 0, excused: 0 };
  if (expectation && actual) {
    const hits = model.planesOf.get(shown.backend)?.find((plane) => plane.name === 'HitSuccess');
    found.mask = compareMask(model.planesOf.get('expected') ?? [], expectation.index, hits);
  }
  if (!against || !actual) return found;
  const bounds = shown.isAgainstBackend || !expectation ? null : parseTolerance(expectation.tolerance);
  Object.assign(found, compareDisplay(shown.type, against.plane, actual.plane, found.mask, bounds));
  found.isJudged = bounds !== null;
  found.rank = rankErrors(found.errors);
  found.differing = found.errors.reduce((count, error) => count + (error > 0 ? 1 : 0), 0);
  Object.assign(found, countBeyond(found.beyond, bounds && decidable));
  return found;
}

function drawPictures() {
  const { expected, against, actual } = shown;
  const planes = [expected, against, actual].filter(Boolean).map((each) => each.plane);
  if (picture.shown !== shown) picture = comparePlanes();
  if (planes.length === 0) {
    const why = shown.result?.reason;
    if (live && !shown.result) return panes.message(h('p', {}, 'being rendered …'));
    panes.message(figuresTable(model.item, model.details) ?? '', why ? h('pre', {}, why) : '',
      h('p', {}, model.item.planes ? 'No plane of this output was kept.' : 'The run kept no planes of this case: it keeps those of cases with a failure, and with --planes all those of all.'));
    return;
  }
  const view = resolveView({ mode: state().mode, exposure: state().ev, offset: state().off, gamma: state().gamma, normalise: state().norm === 1, channel: state().ch }, shown.type);
  view.range = rangeOf(planes, state().ch < planes[0].channels ? state().ch : -1);
  const made = [];
  if (shown.isAgainstBackend && expected) made.push(planePane('expected', expected, view, picture.mask));
  if (against) made.push(planePane('against', against, view, picture.mask));
  if (actual) made.push(planePane('actual', actual, view, null));
  if (picture.errors) made.push(differencePane());
  panes.show(made);
}

function drawPixelPanel() {
  const [x, y] = currentPixel();
  drawPixel(byId('pixel'), byId('outputs'), { live: live !== null, undecidableAbove: undecidableAbove(), shown, planesOf: model.planesOf, item: model.item, x, y, mask: picture.mask, outputs: index.outputs, rank: picture.rank, differing: picture.differing, update, goTo });
  drawHead(byId('case-head'), {
    item: model.item, details: model.details, shown, update, index,
    filterTag: (tag) => { byId('filter').value = `@${tag}`; update({ f: `@${tag}` }); },
  });
}

async function drawTraceOfPixel() {
  const [x, y] = currentPixel();
  const { item } = model;
  const asked = live && x >= 0 ? live.findTrace(x, y, shown) : null;
  const found = asked ? asked.trace : !live && x >= 0 ? await findTrace(index, item.name, x, y, shown.backend) : null;
  if (item !== model.item) return;
  trace = found;
  const most = trace ? Math.max(...trace.backends.map((record) => record.steps.length)) : 0;
  const step = Math.min(state().step, most - 1);
  document.body.classList.toggle('no-planes', !live && !shown.actual && !shown.expected);
  panes.setOverlay({ worst: shown.actual && worstPixel(), pixel: x >= 0 ? [x, y] : null, trace, step });
  if (!live) drawCommands(byId('commands'), { item, details: model.details, shown, index });
  // In the inspector a trace stays until the next has come; it is not drawn anew with each rendering.
  const drawing = live && trace ? [trace, step, asked.error, ...live.traceBackends(shown)] : [];
  const isDrawn = drawing.length > 0 && drawing.length === drawnTrace.length && drawing.every((each, i) => each === drawnTrace[i]);
  drawnTrace = drawing;
  if (isDrawn) return;
  drawRecord(byId('record'), trace, step);
  drawTracePanel(byId('trace'), { item, shown, x, y, trace, step, index, update, added: takeTrace,
    live: live && { backends: index.backends.map((each) => each.name), chosen: live.traceBackends(shown), error: asked?.error ?? '' } });
}

function takeTrace(given) {
  if (given.case === state().case) update({ x: given.pixel[0], y: given.pixel[1], step: 0 });
  else if (cases.has(given.case)) {
    goToCase(given.case);
    update({ x: given.pixel[0], y: given.pixel[1], step: 0 });
  } else say(`the trace is of ${given.case}, which is not in this run`);
  drawTraceOfPixel();
}

function drawTools() {
  drawToolbar(byId('toolbar'), { state: state(), shown, sources: [...model.planesOf.keys()], update });
}

function drawAll() {
  shown = choose(state(), model.item, model.details, model.planesOf, index.outputs);
  drawPictures();
  drawTools();
  drawPixelPanel();
  drawTraceOfPixel();
}

const kPlaces = new Set(['z', 'cx', 'cy']);
const kOther = new Set(['f', 'page', 'error', 'cost', 'cube', 'yaw', 'pitch', 'fov', 'mip', 'glow', 'at', 'figure']); // not of the pictures
const kView = new Set(['mode', 'ev', 'off', 'norm', 'ch', 'gamma', 'dx', 'signed', 'layout', 'hatch', 'worst', 'grid']);
const kPixel = new Set(['x', 'y', 'step', 'follow', 'beside']);
const kAsked = new Set(['p', 'b']); // of the inspector's server

function react(_, keys) {
  if (keys.has('f')) {
    byId('filter').value = state().f;
    list.draw(state().f);
    list.select(state().case);
  }
  if (['page', 'error', 'cost', 'cube', 'at', 'figure'].some((key) => keys.has(key))) showPage();
  const item = cases.get(state().case);
  if (keys.has('case') && item) return void loadCase(item);
  if (!model.item) return;
  if (live && [...kAsked].some((key) => keys.has(key))) live.changed();
  const isOnly = (allowed) => [...keys].every((key) => allowed.has(key) || kPlaces.has(key));
  if (isOnly(kPlaces)) panes.draw();
  else if (isOnly(kOther)) return;
  else if (isOnly(kAsked)) drawTraceOfPixel();
  else if (isOnly(new Set(['split']))) panes.draw();
  else if (isOnly(kView)) {
    drawPictures();
    drawTools();
  } else if (isOnly(kPixel)) {
    drawPixelPanel();
    drawTraceOfPixel();
    panes.draw();
  } else drawAll();
}

const pageShown = () => (pages.includes(state().page) ? state().page : '');

function showPage() {
  const page = pageShown();
  for (const name of Object.keys(kPages)) {
    byId(name).hidden = name !== page;
    byId(`show-${name}`).hidden = !pages.includes(name);
    byId(`show-${name}`).setAttribute('aria-pressed', String(name === page));
    byId(`show-${name}`).onclick = () => update({ page: state().page === name ? '' : name });
  }
  document.body.classList.toggle('other-page', page !== '');
  if (page === '') panes.draw();
  else kPages[page](byId(page), { index, state, update, has: (name) => cases.has(name) });
}

function goTo(by) {
  const plane = shown.actual?.plane;
  if (!plane || picture.rank.length === 0) return say('no pixel differs');
  const [x, y] = currentPixel();
  const at = picture.rank.indexOf(y * plane.width + x);
  const next = picture.rank[at < 0 ? 0 : Math.min(picture.rank.length - 1, Math.max(0, at + by))];
  update({ x: next % plane.width, y: Math.floor(next / plane.width) });
}

function movePixel(dx, dy, event) {
  const plane = shown?.actual?.plane ?? shown?.expected?.plane;
  if (!plane) return;
  const by = event.shiftKey ? 8 : 1;
  const [x, y] = currentPixel();
  update({ x: Math.min(plane.width - 1, Math.max(0, x + dx * by)), y: Math.min(plane.height - 1, Math.max(0, y + dy * by)) });
}

function moveStep(by) {
  if (!trace) return say('no trace of this pixel');
  const most = Math.max(...trace.backends.map((record) => record.steps.length));
  update({ step: Math.min(most - 1, Math.max(0, state().step + by)) });
}

function moveCase(by) {
  goToCase(list.neighbour(state().case, by));
}

const toggle = (key, value, other) => update({ [key]: state()[key] === value ? other : value });

const actions = {
  '?': openHelp,
  '/': () => byId('filter').focus(),
  '[': () => moveCase(-1),
  ']': () => moveCase(1),
  b: () => toggle('layout', 'blink', 'side'),
  d: () => toggle('layout', 'difference', 'side'),
  e: (event) => update({ ev: Math.min(10, Math.max(-10, state().ev + (event.shiftKey ? -0.5 : 0.5))) }),
  u: () => goTo(1),
  y: () => goTo(-1),
  w: () => { const worst = worstPixel(); if (worst) update({ x: worst[0], y: worst[1] }); },
  PageUp: () => moveStep(-1),
  PageDown: () => moveStep(1),
  Home: () => { toggle('follow', 1, 0); say(state().follow ? 'the pixel follows the mouse' : 'the pixel stays'); },
  '+': () => panes.zoomBy(1.5),
  '=': () => panes.zoomBy(1.5),
  '-': () => panes.zoomBy(1 / 1.5),
  0: () => update({ z: 0, cx: 0.5, cy: 0.5 }),
  ArrowLeft: (event) => movePixel(-1, 0, event),
  ArrowRight: (event) => movePixel(1, 0, event),
  ArrowUp: (event) => movePixel(0, -1, event),
  ArrowDown: (event) => movePixel(0, 1, event),
};
const kOfAnyPage = new Set(['?', '/', '[', ']']);
for (let i = 1; i <= 9; ++i) actions[i] = () => shown?.names[i - 1] && update({ o: shown.names[i - 1], e: -1 });

function drawTop() {
  const { counts } = index.run;
  if (live) byId('counts').replaceChildren(h('span', {}, 'inspector'), h('span', { class: 'dim' }, `${index.cases.length} cases`));
  else byId('counts').replaceChildren(
    h('span', { class: counts.failed > 0 ? 'failed' : 'dim' }, `✕ ${counts.failed} failed`),
    h('span', { class: 'passed' }, `✓ ${counts.passed} passed`), h('span', { class: 'dim' }, `– ${counts.skipped} skipped`));
  const commit = index.run.commit ? ` · ${index.run.commit.slice(0, 8)}${index.run.modified ? '+' : ''}` : '';
  byId('run-facts').textContent = `${index.run.started.replace('T', ' ').replace('Z', ' UTC')}${commit}`
    + (index.leftOut.length > 0 ? ' · not all planes are in this file: see Run' : '');
  byId('skip').onclick = (event) => { // the hash is the state, no place in the page
    event.preventDefault();
    byId('panes').focus();
  };
  byId('show-run').onclick = () => openRun(index);
  byId('help').onclick = openHelp;
  byId('theme').onclick = () => {
    const isDark = getComputedStyle(document.documentElement).getPropertyValue('--is-dark').trim() === '1';
    document.documentElement.dataset.theme = isDark ? 'light' : 'dark';
    try { localStorage.setItem('crossray-theme', document.documentElement.dataset.theme); } catch { /* not kept then */ }
  };
  try { document.documentElement.dataset.theme = localStorage.getItem('crossray-theme') ?? ''; } catch { /* by the system */ }
}

function start() {
  if (index.schema !== kSchema) throw new Error(`the data are ${index.schema}; this page reads ${kSchema}`);
  drawTop();
  const filter = byId('filter');
  filter.value = state().f;
  filter.addEventListener('input', () => update({ f: filter.value }));
  filter.addEventListener('keydown', (event) => {
    if (event.key === 'Enter' || event.key === 'ArrowDown') {
      event.preventDefault();
      byId('cases').focus();
      if (!cases.has(state().case) || list.neighbour(state().case, 0) === null) goToCase(list.first());
    }
  });
  list.draw(state().f);
  listenToKeys((key) => (pageShown() === '' || kOfAnyPage.has(key) ? actions[key] : null), (held) => panes.holdShift(held));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', async (event) => {
    event.preventDefault();
    try {
      for (const file of event.dataTransfer.files) takeTrace(addTrace(await file.text()));
    } catch (error) {
      say(`no trace: ${error.message}`);
    }
  });
  showPage();
  const item = cases.get(state().case);
  if (state().case !== '' && !item) say(`this run has no case ${state().case}`);
  const first = item ?? cases.get(list.first());
  if (first && first !== item) update({ case: first.name });
  else if (first) loadCase(first);
  else panes.message(h('p', {}, index.leftOut[0] ?? 'This run has no cases.'));
}

start();
