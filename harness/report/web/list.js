// The left list: failures first, like ones together, then everything else by folder.
import { filterCase, parseFilter } from 'crossray/filter.js';
import { h, verdictMark } from 'crossray/dom.js';

/** What failures have in common when they look the same: output and kind, else the verdict and its words. */
export function failureKey(result) {
  if (result.output && result.kind) return `${result.output}: ${result.kind}`;
  if (result.output && result.verdict !== 'missing-golden') return `${result.output}: ${result.verdict}`;
  const words = (result.reason ?? '').split('\n')[0].replace(/[\d.e+-]*\d[\d.e+-]*/gi, '#').replace(/'[^']*'/g, '#');
  return result.verdict === 'missing-golden' ? 'no golden file' : `${result.verdict}: ${words.slice(0, 60)}`;
}

/**
 * Groups in the order of the list: [{title, failed, items: [{item, results}]}]. `results` are those of the case that the
 * filter leaves; a case stands under the failure that most of its backends have.
 */
export function groupCases(cases, filterText) {
  const terms = parseFilter(filterText);
  const failures = new Map();
  const others = new Map();
  for (const item of cases) {
    const results = filterCase(terms, item);
    if (results === null) continue;
    const failed = results.filter((result) => result.tally === 'failed');
    const counts = new Map();
    for (const result of failed) counts.set(failureKey(result), (counts.get(failureKey(result)) ?? 0) + 1);
    const key = [...counts].sort((a, b) => b[1] - a[1])[0]?.[0];
    const title = key ?? item.name.split('/').slice(0, -1).join('/');
    const groups = key === undefined ? others : failures;
    if (!groups.has(title)) groups.set(title, []);
    groups.get(title).push({ item, results });
  }
  const bySize = [...failures].sort((a, b) => b[1].length - a[1].length);
  return [
    ...bySize.map(([title, items]) => ({ title, failed: true, items })),
    ...[...others].map(([title, items]) => ({ title: title || 'cases', failed: false, items })),
  ];
}

function describeBackends(item, results) {
  const failed = results.filter((result) => result.tally === 'failed').map((result) => result.backend);
  if (failed.length > 0) return failed.length === item.results.length ? 'on all' : failed.join(' ');
  const skipped = results.filter((result) => result.tally === 'skipped').length;
  return skipped > 0 ? `${skipped} skipped` : '';
}

function worstResult(results) {
  const order = { failed: 0, skipped: 1, passed: 2 };
  return [...results].sort((a, b) => order[a.tally] - order[b.tally])[0] ?? { verdict: 'not rendered', tally: 'skipped' }; // in the inspector
}

// Names may break behind these signs.
function breakable(name) {
  return name.split(/(?<=[/_,[=])/).flatMap((part, i) => (i === 0 ? [part] : [document.createElement('wbr'), part]));
}

function makeRow({ item, results }, id, isFailed) {
  const passed = results.filter((result) => result.tally === 'passed');
  const worst = isFailed || passed.length === 0 ? worstResult(results) : passed[0];
  const shortName = isFailed ? item.name : item.name.split('/').pop();
  const backends = describeBackends(item, results);
  return h('div', { role: 'option', id, class: 'row', 'data-name': item.name, title: `${item.name}\n${item.summary}` },
    verdictMark(worst.verdict, worst.tally),
    h('span', { class: 'hidden' }, worst.verdict),
    h('span', { class: 'name' }, breakable(shortName)),
    backends && h('span', { class: 'on' }, backends));
}

/** Draws the list and keeps its keys: `choose(name)` hears a choice. */
export function createList(cases, choose) {
  const box = document.getElementById('cases');
  const count = document.getElementById('filter-count');
  let rows = [];

  function draw(filterText) {
    const groups = groupCases(cases, filterText);
    rows = [];
    const parts = groups.map((group, g) => {
      const options = group.items.map((entry) => {
        const row = makeRow(entry, `case-${rows.length}`, group.failed);
        rows.push(row);
        return row;
      });
      const title = h('div', { class: group.failed ? 'group failed' : 'group', id: `group-${g}`, role: 'presentation' },
        h('span', {}, group.title), h('span', { class: 'size' }, String(group.items.length)));
      return h('div', { role: 'group', 'aria-labelledby': `group-${g}` }, title, ...options);
    });
    box.replaceChildren(...(parts.length > 0 ? parts : [h('p', { class: 'empty' }, 'No case fits the filter.')]));
    count.textContent = filterText.trim() === '' ? `${cases.length}` : `${rows.length} of ${cases.length}`;
  }

  function select(name, scroll = true) {
    for (const row of rows) {
      const chosen = row.dataset.name === name;
      row.setAttribute('aria-selected', String(chosen));
      if (!chosen) continue;
      box.setAttribute('aria-activedescendant', row.id);
      if (scroll) row.scrollIntoView({ block: 'nearest' });
    }
  }

  /** The case so many rows on; null at an end. */
  function neighbour(name, by) {
    const at = rows.findIndex((row) => row.dataset.name === name);
    return rows[at < 0 ? 0 : at + by]?.dataset.name ?? null;
  }

  box.addEventListener('click', (event) => {
    const row = event.target.closest('[role=option]');
    if (row) choose(row.dataset.name);
  });
  box.addEventListener('keydown', (event) => {
    const by = { ArrowDown: 1, ArrowUp: -1, PageDown: 12, PageUp: -12 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const selected = box.querySelector('[aria-selected=true]');
    const at = rows.indexOf(selected);
    const row = rows[Math.min(rows.length - 1, Math.max(0, at + by))];
    if (row) choose(row.dataset.name);
  });
  return { draw, select, neighbour, first: () => rows[0]?.dataset.name ?? null };
}
