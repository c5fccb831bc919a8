// What is true of the whole run, in a dialog.
import { h } from 'crossray/dom.js';
import { openDialog } from 'crossray/keys.js';
import { formatShort } from 'crossray/numbers.js';

export function openRun(index) {
  const { run } = index;
  const facts = [['started', run.started], ['took', `${formatShort(run.seconds)} s on ${run.cores} processors`], ['command', run.commandLine.join(' ')],
    ['crossray', `${run.version}${run.commit ? `, commit ${run.commit}${run.modified ? ' with changes' : ''}` : ''}`],
    ...Object.entries(run.compilers), ...(run.interrupted ? [['interrupted', 'cases that were not reached are absent']] : [])];
  const rows = (pairs) => pairs.map(([name, text]) => h('tr', {}, h('th', { scope: 'row' }, name), h('td', {}, text)));
  const section = (title, lines) => lines.length > 0 && h('section', {}, h('h3', {}, title), h('ul', {}, lines.map((line) => h('li', {}, line))));
  openDialog('Run', h('table', { class: 'help' }, h('caption', { class: 'hidden' }, 'Facts'), h('tbody', {}, rows(facts))),
    h('table', { class: 'help' }, h('caption', {}, 'Backends'), h('tbody', {}, rows(Object.entries(run.backends).map(([name, each]) => [name,
      each.environmentError || [each.device, each.driver, each.api, each.cpu].filter(Boolean).join(' · ')])))),
    section('Left out of this file', index.leftOut) || '', section('Broken case files', run.brokenFiles) || '');
}
