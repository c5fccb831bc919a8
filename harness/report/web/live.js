// The inspector: what the page asks the server for. Of renders and of traces the newest counts; one of each is on its way.
import { takePiecesFrom } from 'crossray/data.js';
import { planesFromBytes } from 'crossray/planes.js';
import { parametersOf, parseParameters } from 'crossray/parameters.js';
import { createLivePanel } from 'crossray/live_panel.js';
import { createServer, Refused } from 'crossray/server.js';
import { reviveTrace } from 'crossray/trace.js';

const kPatience = 300; // milliseconds after which a newer render does not wait for the answer to an older one
const kLong = 400; // milliseconds after which progress is shown

/**
 * `hooks`: {state(), update(patch), showItem(item): promise, showTrace(), added(item)}. The page calls open(item) for the
 * case that is shown, changed() when parameters or backends are others, and findTrace() for the pixel.
 */
export function createLive(index, hooks) {
  const server = createServer(index.token, { gone: (reason) => panel.lost(reason), back: recover });
  const panel = createLivePanel(index, { ...hooks, backends, cancel: () => server.request('/cancel', {}).catch(() => {}), save });
  takePiecesFrom(async (name) => {
    const answer = await server.request(`/data/${encodeURIComponent(name)}`);
    return answer instanceof ArrayBuffer ? planesFromBytes(answer) : answer;
  });

  let caseName = '';
  let controls = [];
  let generation = 0;
  let running = null; // the render on its way
  let retry = 0;
  let traced = { key: '', caseName: '', trace: null, error: '' };
  let tracing = false;
  let wantedTrace = null; // {key, body, since}

  function backends() {
    const known = index.backends.map((each) => each.name);
    const chosen = hooks.state().b.split(',').filter((name) => known.includes(name));
    return chosen.length > 0 ? chosen : index.backends.filter((each) => each.default).map((each) => each.name);
  }

  const parameters = () => parametersOf(controls, hooks.state().p);

  async function open(item) {
    caseName = item.name;
    try {
      ({ controls } = await server.request(`/controls?case=${encodeURIComponent(item.name)}`));
    } catch (error) {
      if (caseName === item.name) panel.say(error instanceof Refused ? error.message : '');
      controls = [];
    }
    if (caseName !== item.name) return;
    panel.showControls(controls);
    changed();
  }

  function changed() {
    panel.show(parseParameters(hooks.state().p));
    if (caseName === '' || server.isGone()) return;
    clearTimeout(retry);
    const waited = running ? performance.now() - running.since : Infinity;
    if (waited < kPatience) retry = setTimeout(changed, kPatience - waited);
    else render();
  }

  async function render() {
    const mine = { generation: ++generation, since: performance.now(), caseName, isStale: () => mine.generation !== generation || mine.caseName !== caseName };
    const asked = { parameters: parameters(), backends: backends() };
    running = mine;
    panel.rendering(true);
    const watch = setTimeout(() => watchProgress(mine), kLong);
    try {
      const answer = await server.request('/render', { case: caseName, ...asked, generation: mine.generation });
      if (mine.isStale()) return;
      await hooks.showItem({ ...answer.item, planes: answer.planes ?? answer.item.planes });
      panel.rendered(answer.milliseconds, performance.now() - mine.since);
    } catch (error) {
      if (!mine.isStale() && error instanceof Refused) panel.failed(error.answer.cancelled ? 'cancelled' : error.answer.superseded ? '' : error.message);
    } finally {
      clearTimeout(watch);
      if (running === mine) {
        running = null;
        panel.rendering(false);
        const isNewer = JSON.stringify(asked) !== JSON.stringify({ parameters: parameters(), backends: backends() }) || mine.caseName !== caseName;
        if (isNewer && !server.isGone()) changed();
      }
    }
  }

  async function watchProgress(mine) {
    while (running === mine && !server.isGone()) {
      try {
        const progress = await server.request('/progress');
        if (running === mine) panel.progress(progress);
      } catch { /* render() tells it */ }
      await new Promise((done) => setTimeout(done, 250));
    }
  }

  // The backend that is shown, and the one that says most beside it.
  function traceBackends(shown) {
    const chosen = backends();
    const first = index.backends.some((each) => each.name === shown.backend) ? shown.backend : chosen[0];
    const { beside } = hooks.state();
    const second = beside === 'none' ? undefined
      : [beside, shown.isAgainstBackend ? shown.against.title : '', 'cpu64', ...chosen].find((name) => name !== first && index.backends.some((each) => each.name === name));
    return second ? [first, second] : [first];
  }

  /** The trace of a pixel: what there is at once, and hooks.showTrace() when it has come. Null: none of this case yet. */
  function findTrace(x, y, shown) {
    const body = { case: caseName, parameters: parameters(), backends: traceBackends(shown), pixel: [x, y] };
    const key = JSON.stringify(body);
    if (key !== traced.key && key !== wantedTrace?.key) {
      wantedTrace = { key, body, since: performance.now() };
      if (!tracing) fetchTraces();
    }
    return { trace: traced.caseName === caseName ? traced.trace : null, error: key === traced.key ? traced.error : '', isComing: key !== traced.key };
  }

  async function fetchTraces() {
    tracing = true;
    while (wantedTrace && !server.isGone()) {
      const { key, body, since } = wantedTrace;
      try {
        const answer = await server.request('/trace', body);
        traced = { key, caseName: body.case, trace: reviveTrace(answer), error: '' };
        hooks.showTrace();
        requestAnimationFrame(() => panel.traced(answer.milliseconds, performance.now() - since));
      } catch (error) {
        if (!(error instanceof Refused)) break; // asked again when the server is back
        if (!error.answer.superseded) {
          traced = { key, caseName: body.case, trace: null, error: error.message };
          hooks.showTrace();
        }
      }
      if (wantedTrace?.key === key) wantedTrace = null;
    }
    tracing = false;
  }

  async function save(name) {
    try {
      const answer = await server.request('/save', { case: caseName, parameters: parameters(), name });
      if (answer.item) hooks.added(answer.item);
      panel.saved(answer.file);
    } catch (error) {
      panel.saved('', error.message);
    }
  }

  function recover() {
    panel.found();
    running = null;
    traced = { key: '', caseName: '', trace: null, error: '' };
    if (wantedTrace && !tracing) fetchTraces();
    if (controls.length > 0) changed();
    else if (caseName !== '') open({ name: caseName });
    hooks.showTrace();
  }

  return { open, changed, findTrace, backends, traceBackends };
}
