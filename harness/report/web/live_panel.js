// The inspector's own part of the page: which backends render, how long that took, progress, the parameters, saving, and
// the banner when the server is gone.
import { createControls } from 'crossray/controls.js';
import { h, redraw } from 'crossray/dom.js';
import { formatShort } from 'crossray/numbers.js';
import { formatParameters, parseParameters } from 'crossray/parameters.js';

const byId = (id) => document.getElementById(id);
const kGone = {
  silent: () => `The server does not answer; what is shown is the last that it sent. Start it again, crossray inspect --port ${location.port}: the page goes on by itself.`,
  other: () => 'The server was started anew with another token: open the address that it printed.',
};

function milliseconds(value) {
  return `${value < 10 ? value.toFixed(1) : Math.round(value)} ms`;
}

/** `hooks`: those of createLive, and {backends(), cancel(), save(name)}. */
export function createLivePanel(index, hooks) {
  const status = h('p', { class: 'live-status', role: 'status' }, 'not rendered yet');
  const traceStatus = h('p', { class: 'live-status trace-time' });
  const bar = h('progress', { 'aria-label': 'Progress', max: '1' });
  const what = h('span', { class: 'dim' });
  const work = h('div', { class: 'work', hidden: true }, bar, what, h('button', { type: 'button', class: 'small', onclick: hooks.cancel }, 'Cancel'));
  const backendBox = h('fieldset', { class: 'backends' });
  const resetAll = h('button', { type: 'button', class: 'small', onclick: () => hooks.update({ p: '' }) }, 'Reset all');
  const name = h('input', { type: 'text', id: 'save-name', placeholder: 'name', spellcheck: false, autocomplete: 'off' });
  const savedNote = h('p', { class: 'live-status', role: 'status' });
  const saveForm = h('form', { class: 'save', onsubmit: (event) => {
    event.preventDefault();
    if (name.value.trim() !== '') hooks.save(name.value.trim());
    else name.focus();
  } }, h('label', { for: 'save-name' }, 'Save as a new case'), name, h('button', { type: 'submit', class: 'small' }, 'Save'));
  const list = h('div', { class: 'parameter-list' });
  const controls = createControls(list, (path, value) => {
    const values = parseParameters(hooks.state().p);
    if (value === undefined) delete values[path];
    else values[path] = String(value);
    hooks.update({ p: formatParameters(values) });
  });
  byId('controls').hidden = false;
  byId('controls').replaceChildren(h('div', { class: 'live-head' }, h('h2', {}, 'Parameters'), resetAll), backendBox, status, traceStatus, work, list, saveForm, savedNote);
  document.body.classList.add('live');

  function drawBackends() {
    const chosen = hooks.backends();
    redraw(backendBox, h('legend', {}, 'render on'), index.backends.map(({ name: each }) => h('label', { class: 'control check' },
      h('input', { type: 'checkbox', checked: chosen.includes(each), onchange: (event) => {
        const next = index.backends.map((known) => known.name).filter((known) => (known === each ? event.target.checked : chosen.includes(known)));
        if (next.length === 0) event.target.checked = true; // one at least
        else hooks.update({ b: next.join(',') });
      } }), each)));
  }

  return {
    showControls: (all) => {
      controls.build(all);
      savedNote.textContent = '';
    },
    /** The values that are changed, and the backends that are chosen. */
    show(values) {
      controls.show(values);
      drawBackends();
      const count = Object.keys(values).length;
      resetAll.disabled = count === 0;
      resetAll.textContent = count === 0 ? 'Reset all' : `Reset all ${count}`;
    },
    rendering(is) {
      byId('controls').setAttribute('aria-busy', String(is));
      if (!is) work.hidden = true;
    },
    progress({ busy, what: doing, done, total, seconds }) {
      work.hidden = !busy;
      if (total > 0) Object.assign(bar, { max: total, value: done });
      else bar.removeAttribute('value');
      what.textContent = `${doing} ${total > 0 ? `${done} of ${total}, ` : ''}${formatShort(seconds, 2)} s`;
    },
    rendered(times, seen) {
      const each = Object.entries(times.backends ?? {}).map(([backend, ms]) => `${backend} ${milliseconds(ms)}`);
      status.className = 'live-status';
      status.textContent = `rendered in ${milliseconds(times.total)}${each.length > 0 ? ` (${each.join(', ')})` : ''}, shown after ${milliseconds(seen)}`;
      status.dataset.seen = seen.toFixed(1);
      status.dataset.renders = String(Number(status.dataset.renders ?? 0) + 1);
    },
    traced(times, seen) {
      const each = Object.entries(times?.backends ?? {}).map(([backend, ms]) => `${backend} ${milliseconds(ms)}`);
      traceStatus.textContent = `ray drawn after ${milliseconds(seen)}${each.length > 0 ? ` (${each.join(', ')})` : ''}`;
      traceStatus.dataset.seen = seen.toFixed(1);
      traceStatus.dataset.traces = String(Number(traceStatus.dataset.traces ?? 0) + 1);
    },
    failed(reason) {
      if (reason === '') return;
      status.className = 'live-status failed';
      status.textContent = reason === 'cancelled' ? '– cancelled; what is shown is older' : `✕ ${reason}`;
    },
    saved(file, error) {
      savedNote.className = error ? 'live-status failed' : 'live-status';
      savedNote.textContent = error ? `✕ ${error}` : `✓ saved: ${file}`;
      if (!error) name.value = '';
    },
    say: (text) => text && (status.textContent = text),
    lost(reason) {
      const banner = byId('banner');
      if (banner.textContent !== kGone[reason]()) banner.textContent = kGone[reason](); // said once, not each time
      banner.hidden = false;
      work.hidden = true;
    },
    found: () => (byId('banner').hidden = true),
  };
}
