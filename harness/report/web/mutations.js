// What `crossray mutate` found: the score of each file, the bugs that survived with their edits, and the cases that catch none.
import { h } from 'crossray/dom.js';

/** "97.3 %", or a dash where nothing counts. */
export function formatScore(score) {
  return score === null || score === undefined ? '–' : `${(score * 100).toFixed(1)} %`;
}

/** Those that survived, the files with the most first, in the order of their lines. */
export function survivorsOf(hunt) {
  const all = hunt.mutants.filter((mutant) => mutant.end === 'survived');
  const count = (file) => all.filter((mutant) => mutant.file === file).length;
  return all.sort((a, b) => count(b.file) - count(a.file) || a.file.localeCompare(b.file) || a.line - b.line);
}

/** A section of the page of charts. `has(name)`: the run has that case. */
export function drawMutations(hunt, has) {
  const columns = [['bugs', 'mutants'], ['caught', 'caught'], ['survived', 'survived'], ['equivalent', 'equivalent'], ['same code', 'sameCode'], ['unreached', 'unreached']];
  const row = (counts) => h('tr', {}, h('th', { scope: 'row' }, counts.name), columns.map(([, key]) => h('td', { class: 'number' }, String(counts[key]))),
    h('td', { class: 'number' }, formatScore(counts.score)));
  const link = (name) => (has(name) ? h('a', { href: `#case=${encodeURIComponent(name)}` }, name) : name);
  const survivors = survivorsOf(hunt);
  return h('section', { class: 'chart-section' },
    h('h3', {}, `Planted bugs: ${formatScore(hunt.all.score)} caught`, h('span', { class: 'dim' }, ` on ${hunt.backend}, ${hunt.all.mutants} of ${hunt.planted}`)),
    h('div', { class: 'chart-table', tabindex: '0', role: 'region', 'aria-label': 'Planted bugs by file' }, h('table', { class: 'figures' },
      h('caption', { class: 'hidden' }, 'Planted bugs by file'),
      h('thead', {}, h('tr', {}, ['file', ...columns.map(([name]) => name), 'score'].map((name) => h('th', { scope: 'col' }, name)))),
      h('tbody', {}, [...hunt.files, hunt.all].map(row)))),
    survivors.length > 0 && h('details', {}, h('summary', {}, `${survivors.length} survived`), survivors.map((mutant) => h('div', {},
      h('p', {}, `${mutant.file}:${mutant.line}`, mutant.seen.length > 0 && h('span', { class: 'dim' }, ' seen by ', link(mutant.seen[0].case))),
      h('pre', {}, `-${mutant.before}\n+${mutant.after}`)))),
    hunt.idleCases.length > 0 && h('details', {}, h('summary', {}, `${hunt.idleCases.length} cases catch none of the bugs that they were asked about`),
      h('ul', {}, hunt.idleCases.map((name) => h('li', {}, link(name))))));
}
