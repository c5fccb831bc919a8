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

function makeRow({ item, results }, at, isFailed) {
  const passed = results.filter((result) => result.tally === 'passed');
  const worst = isFailed || passed.length === 0 ? worstResult(results) : passed[0];
  const shortName = isFailed ? item.name : item.name.split('/').pop();
  const backends = describeBackends(item, results);
  return h('div', { role: 'option', id: `case-${at}`, class: 'row', 'aria-selected': 'false', 'data-name': item.name, title: `${item.name}\n${item.summary}` },
    verdictMark(worst.verdict, worst.tally),
    h('span', { class: 'hidden' }, worst.verdict),
    h('span', { class: 'name' }, breakable(shortName)),
    backends && h('span', { class: 'on' }, backends));
}

const kRowsAtOnce = 1000; // so many are drawn at once; of more each piece is drawn when it comes near
const kRowsOfPiece = 200;
const kRowHeight = 22; // of a name on one line

/** Draws the list and keeps its keys: `choose(name)` hears a choice. */
export function createList(cases, choose) {
  const box = document.getElementById('cases');
  const count = document.getElementById('filter-count');
  let entries = []; // of the rows, drawn or not
  let places = new Map(); // name -> place among them
  let pieces = []; // of the rows, in order: {box, start, end, isFailed, isDrawn}
  let selected = null; // a row
  const nearness = new IntersectionObserver((seen) => {
    for (const { target, isIntersecting } of seen) if (isIntersecting) drawPiece(pieces[Number(target.dataset.piece)]);
  }, { root: box, rootMargin: '100%' });

  function drawPiece(piece) {
    if (!piece || piece.isDrawn) return;
    piece.isDrawn = true;
    nearness.unobserve(piece.box);
    piece.box.style.minHeight = '';
    const rows = entries.slice(piece.start, piece.end).map((entry, i) => makeRow(entry, piece.start + i, piece.isFailed));
    if (entries.length > kRowsAtOnce) {
      rows.forEach((row, i) => {
        row.setAttribute('aria-setsize', String(entries.length));
        row.setAttribute('aria-posinset', String(piece.start + i + 1));
      });
    }
    piece.box.replaceChildren(...rows);
  }

  function makePieces(group) {
    const made = [];
    for (let first = 0; first < group.items.length; first += kRowsOfPiece) {
      const items = group.items.slice(first, first + kRowsOfPiece);
      const start = entries.length;
      for (const entry of items) {
        places.set(entry.item.name, entries.length);
        entries.push(entry);
      }
      const piece = { start, end: entries.length, isFailed: group.failed, isDrawn: false,
        box: h('div', { role: 'presentation', 'data-piece': String(pieces.length), style: `min-height:${items.length * kRowHeight}px` }) };
      pieces.push(piece);
      made.push(piece.box);
    }
    return made;
  }

  function draw(filterText) {
    const groups = groupCases(cases, filterText);
    nearness.disconnect();
    [entries, places, pieces, selected] = [[], new Map(), [], null];
    const parts = groups.map((group, g) => {
      const title = h('div', { class: group.failed ? 'group failed' : 'group', id: `group-${g}`, role: 'presentation' },
        h('span', {}, group.title), h('span', { class: 'size' }, String(group.items.length)));
      return h('div', { role: 'group', 'aria-labelledby': `group-${g}` }, title, ...makePieces(group));
    });
    for (const piece of pieces) {
      if (entries.length <= kRowsAtOnce || piece.end <= kRowsOfPiece) drawPiece(piece);
      else nearness.observe(piece.box);
    }
    box.replaceChildren(...(parts.length > 0 ? parts : [h('p', { class: 'empty' }, 'No case fits the filter.')]));
    count.textContent = filterText.trim() === '' ? `${cases.length}` : `${entries.length} of ${cases.length}`;
  }

  function rowOf(name) {
    const at = places.get(name);
    if (at === undefined) return null;
    drawPiece(pieces.find((piece) => at < piece.end));
    return document.getElementById(`case-${at}`);
  }

  function select(name, scroll = true) {
    selected?.setAttribute('aria-selected', 'false');
    selected = rowOf(name);
    if (!selected) return;
    selected.setAttribute('aria-selected', 'true');
    box.setAttribute('aria-activedescendant', selected.id);
    if (scroll) selected.scrollIntoView({ block: 'nearest' });
  }

  /** The case so many rows on; null at an end. */
  function neighbour(name, by) {
    const at = places.get(name);
    return entries[at === undefined ? 0 : at + by]?.item.name ?? null;
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
    const at = selected ? places.get(selected.dataset.name) : -1;
    const entry = entries[Math.min(entries.length - 1, Math.max(0, at + by))];
    if (entry) choose(entry.item.name);
  });
  return { draw, select, neighbour, first: () => entries[0]?.item.name ?? null };
}
