// Above the pictures: what the case claims, which backend and output are shown, and what the expectation says.
import { fileNameOf } from 'crossray/atlas_text.js';
import { acceptCommand, knownFailureToml, runCommand } from 'crossray/commands.js';
import { commandLine, h, redraw, verdictMark } from 'crossray/dom.js';
import { className, formatShort, numberOf } from 'crossray/numbers.js';

function backendTabs(item, shown, update) {
  return h('div', { class: 'tabs', role: 'group', 'aria-label': 'Backend' }, item.results.map((result) => h('button', {
    type: 'button', class: 'tab', 'aria-pressed': String(result.backend === shown.backend),
    title: result.reason ?? 'pass', onclick: () => update({ a: result.backend, e: -1 }),
  }, verdictMark(result.verdict, result.tally), result.backend, h('span', { class: 'hidden' }, ` ${result.verdict}`))));
}

function outputTabs(shown, details, update) {
  const result = details?.backends.find((each) => each.backend === shown.backend);
  const stateOf = (name) => {
    const expectations = result?.expectations.filter((each) => each.output === name) ?? [];
    if (expectations.length === 0) return null;
    const isBad = expectations.some((each) => each.missingGolden || (each.judged && each.comparison.passed === details.mustFail));
    return isBad ? verdictMark('fail', 'failed') : verdictMark('pass', 'passed');
  };
  return h('div', { class: 'tabs', role: 'group', 'aria-label': 'Output' }, shown.names.map((name, i) => h('button', {
    type: 'button', class: 'tab', 'aria-pressed': String(name === shown.output),
    'aria-keyshortcuts': i < 9 ? String(i + 1) : undefined, onclick: () => update({ o: name, e: -1 }),
  }, i < 9 && h('kbd', {}, String(i + 1)), name, stateOf(name))));
}

function confusionTable(confusion) {
  const names = [0, 1, 2, 3].map(className);
  return h('table', { class: 'confusion' },
    h('caption', {}, 'rows expected, columns actual'),
    h('thead', {}, h('tr', {}, h('td', {}), names.map((name) => h('th', { scope: 'col' }, name)))),
    h('tbody', {}, confusion.map((row, i) => h('tr', {}, h('th', { scope: 'row' }, names[i]),
      row.map((count, j) => h('td', { class: count > 0 && i !== j ? 'off' : '' }, String(count)))))));
}

function statistics(comparison) {
  const facts = [];
  facts.push(`${comparison.failed} of ${comparison.compared} px beyond`);
  for (const name of ['median', 'p95', 'p99', 'max']) {
    facts.push(`${name} ${formatShort(numberOf(comparison[name]))}`);
  }
  const census = Object.entries(comparison.census).sort((a, b) => b[1] - a[1]).map(([kind, count]) => `${count} ${kind}`);
  const metrics = Object.entries(comparison.metrics).map(([name, value]) => `${name} ${formatShort(numberOf(value))}`);
  return h('div', { class: 'facts-line' }, facts.concat(census, metrics).join(' · '), h('span', { class: 'dim' }, ` in ${comparison.unit}`));
}

function expectationLine(shown, details, update) {
  const result = details?.backends.find((each) => each.backend === shown.backend);
  const all = result?.expectations.filter((each) => each.output === shown.output) ?? [];
  const { expectation } = shown;
  if (!expectation) return h('p', { class: 'dim' }, details ? `nothing is expected of ${shown.output} on ${shown.backend}` : 'its expectations were left out of this file');
  const place = `${expectation.position.file}:${expectation.position.line}`;
  const select = all.length > 1 && h('select', { 'aria-label': 'Expectation', onchange: (event) => update({ e: Number(event.target.value) }) },
    all.map((each) => h('option', { value: each.index, selected: each.index === expectation.index }, `${each.source} (line ${each.position.line})`)));
  const { comparison } = expectation;
  const verdict = !expectation.judged ? ['skip', 'skipped', expectation.note || 'not judged']
    : details.mustFail && !comparison.passed ? ['pass', 'passed', `fails, as it must: ${comparison.reason}`]
      : details.mustFail ? ['fail', 'failed', 'holds, and must fail']
        : comparison.passed ? ['pass', 'passed', 'holds'] : ['fail', 'failed', comparison.reason];
  return h('div', { class: 'expectation' },
    h('p', {}, verdictMark(verdict[0], verdict[1]), h('span', { class: 'why' }, verdict[2])),
    h('p', { class: 'dim' }, select || expectation.source, h('span', {}, ` · tolerance ${expectation.tolerance} · `), h('code', {}, place)),
    expectation.judged && expectation.note && h('p', { class: 'dim' }, expectation.note),
    comparison && statistics(comparison),
    comparison?.confusion && confusionTable(comparison.confusion));
}

function rest(item, details, shown) {
  const result = details?.backends.find((each) => each.backend === shown.backend);
  const lines = [...(result?.messages ?? []), ...(result?.logLines ?? [])];
  if (lines.length === 0) return null;
  return h('details', {}, h('summary', {}, `${lines.length} lines of the driver and worker`), h('pre', {}, lines.join('\n')));
}

/** Fills the head. */
export function drawHead(box, { item, details, shown, update, index, filterTag }) {
  redraw(box,
    h('div', { class: 'case-title' },
      h('h2', {}, item.name),
      item.mustFail && h('span', { class: 'tag' }, 'must fail'),
      index.atlasCases.includes(fileNameOf(item.name)) && h('a', { href: `#${new URLSearchParams({ page: 'atlas', at: `case:${fileNameOf(item.name)}` })}` }, 'in the atlas'),
      h('span', { class: 'dim place' }, `${item.file}:${item.line} · ${item.width} × ${item.height}`)),
    h('p', { class: 'summary' }, item.summary, ' ',
      item.tags.map((tag) => h('button', { type: 'button', class: 'tag', title: 'filter by this tag', onclick: () => filterTag(tag) }, `@${tag}`))),
    backendTabs(item, shown, update),
    outputTabs(shown, details, update),
    expectationLine(shown, details, update),
    rest(item, details, shown));
}

/** The command that shows it again, and for a failure what accepts it: a golden by review, else a known failure. */
export function drawCommands(box, { item, details, shown, index }) {
  const failed = item.results.filter((result) => result.tally === 'failed').map((result) => result.backend);
  const lines = [commandLine('run again', runCommand(item, [shown.backend]))];
  const result = details?.backends.find((each) => each.backend === shown.backend);
  const golden = result?.expectations.find((each) => each.source.startsWith('golden ') && (each.missingGolden || !each.comparison?.passed));
  if (golden) {
    lines.push(commandLine('accept', acceptCommand(item.name, shown.backend, index.runFolder)));
  } else if (failed.length > 0) {
    const until = new Date(Date.parse(index.run.started) + 30 * 86400e3).toISOString().slice(0, 10);
    const reason = item.results.find((each) => each.tally === 'failed').reason ?? '';
    lines.push(commandLine('accept', knownFailureToml(failed, reason, until)),
      h('p', { class: 'dim' }, `No golden decides here: this table in ${item.file} excuses it until its date.`));
  }
  redraw(box, h('h2', {}, failed.length > 0 ? 'See it again, or accept it' : 'See it again'), ...lines);
}

function figure(expectation, mustFail) {
  if (!expectation) return h('td', {}, '');
  if (!expectation.judged) return h('td', { class: 'dim', title: expectation.note }, verdictMark('skip', 'skipped'), 'not judged');
  const { comparison } = expectation;
  const isAsWanted = comparison.passed !== mustFail;
  return h('td', { class: 'number', title: comparison.reason || 'holds' },
    verdictMark(isAsWanted ? 'pass' : 'fail', isAsWanted ? 'passed' : 'failed'), ` ${formatShort(numberOf(comparison.max), 3)}`);
}

/** Where there are no planes: the largest error of each expectation on each backend, and what the backends took. */
export function figuresTable(item, details) {
  if (!details) return null;
  const all = new Map();
  for (const { expectations } of details.backends) for (const each of expectations) all.set(each.index, each);
  const rows = [...all.values()].sort((a, b) => a.index - b.index);
  const resultOf = (name) => details.backends.find((each) => each.backend === name);
  const names = item.results.map((result) => result.backend);
  return h('div', { class: 'figures-box', tabindex: '0', role: 'region', 'aria-label': 'Figures' }, h('table', { class: 'figures' },
    h('caption', {}, 'largest error on each backend'),
    h('thead', {}, h('tr', {}, ['output', 'held to', 'tolerance', ...names].map((name) => h('th', { scope: 'col' }, name)))),
    h('tbody', {}, rows.map((row) => h('tr', {}, h('th', { scope: 'row' }, row.output), h('td', {}, row.source), h('td', {}, row.tolerance, row.comparison && h('span', { class: 'dim' }, `, errors in ${row.comparison.unit}`)),
      names.map((name) => figure(resultOf(name)?.expectations.find((each) => each.index === row.index), details.mustFail)))),
    h('tr', { class: 'times' }, h('th', { scope: 'row' }, 'dispatch, ms'), h('td', {}), h('td', {}),
      names.map((name) => h('td', { class: 'number' }, formatShort(resultOf(name)?.times.dispatch ?? null, 3)))))));
}
