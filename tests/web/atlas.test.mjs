import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { caseNameOf, casesNamed, isAtlasTable, isPicture, parseDocument, parseSpans, resolvePath, spansOf, verdictOf } from '../../harness/report/web/atlas_text.js';

const read = (name) => readFileSync(new URL(`../../${name}`, import.meta.url), 'utf8');
const kAtlas = 'docs/stability.md';
const kSweeps = 'reports/published/sweeps/README.md';

test('paths are those of the repository', () => {
  assert.equal(resolvePath(kAtlas, '../cases/a/b.toml'), 'cases/a/b.toml');
  assert.equal(resolvePath(kAtlas, 'images/x.png'), 'docs/images/x.png');
  assert.equal(resolvePath(kSweeps, './y.svg'), 'reports/published/sweeps/y.svg');
  assert.equal(resolvePath(kAtlas, '../reports/published/README.md#stability-against-cost'), 'reports/published/README.md');
});

test('a line is split into its spans', () => {
  assert.deepEqual(parseSpans('**A** is `b*c*` on [`c`](d.md), *e* 2 * 3', kAtlas), [
    { kind: 'strong', text: 'A' }, { kind: 'text', text: ' is ' }, { kind: 'code', text: 'b*c*' }, { kind: 'text', text: ' on ' },
    { kind: 'link', text: 'c', path: 'docs/d.md' }, { kind: 'text', text: ', ' }, { kind: 'em', text: 'e' }, { kind: 'text', text: ' 2 * 3' },
  ]);
  assert.deepEqual(parseSpans('', kAtlas), []);
});

test('blocks end at an empty line, and a paragraph where a list begins', () => {
  const [section] = parseDocument('# T\nA\nb.\n- one\n  more\n- two\n\n| x | |\n|--|--|\n| 1 | [p](q.svg) |\n\n![alt](r.png)\n', kAtlas);
  assert.deepEqual(section.blocks.map((block) => block.kind), ['paragraph', 'list', 'table', 'picture']);
  assert.deepEqual(section.blocks[1].items.map(([span]) => span.text), ['one more', 'two']);
  assert.deepEqual(section.blocks[2].head, ['x', '']);
  assert.equal(section.blocks[2].rows[0][1][0].path, 'docs/q.svg');
  assert.deepEqual(section.blocks[3], { kind: 'picture', text: 'alt', path: 'docs/r.png' });
});

test('nothing of the documents is left as Markdown', () => {
  for (const name of [kAtlas, kSweeps]) {
    const sections = parseDocument(read(name), name);
    assert.ok(sections.length > 10, name);
    assert.equal(new Set(sections.map((section) => section.id)).size, sections.length, 'ids are their sections\' own');
    for (const span of sections.flatMap(spansOf)) {
      if (span.kind !== 'code') assert.doesNotMatch(span.text, /\*\S|`|\]\(|^\s*[-#|]\s|!\[/, `${name}: ${span.text}`);
    }
  }
});

test('the atlas has each situation, and each row its six cells and a case', () => {
  const rows = parseDocument(read(kAtlas), kAtlas).flatMap((section) => section.blocks.filter(isAtlasTable)).flatMap((block) => block.rows);
  assert.ok(rows.length > 50);
  const numbers = new Set(rows.flatMap((cells) => (cells[0][0].text === '-' ? [] : cells[0][0].text.split(', ').map(Number))));
  assert.deepEqual([...numbers].sort((a, b) => a - b), Array.from({ length: 64 }, (_, i) => i + 1));
  for (const cells of rows) {
    assert.equal(cells.length, 6);
    assert.ok(cells[1].some((span) => span.kind === 'link' && caseNameOf(span.path)), JSON.stringify(cells[1]));
    assert.ok(cells[5].every((span) => span.kind === 'text' || isPicture(span.path)), JSON.stringify(cells[5]));
  }
});

test('each sweep that the atlas shows is explained', () => {
  const sweeps = parseDocument(read(kSweeps), kSweeps).map((section) => [section.blocks.find((block) => block.kind === 'picture')?.path, spansOf(section)]);
  const shown = parseDocument(read(kAtlas), kAtlas).flatMap((section) => [...spansOf(section), ...section.blocks]).map((each) => each.path).filter((path) => path?.startsWith('reports/published/sweeps/'));
  assert.ok(shown.length > 20);
  for (const path of shown) {
    const [, spans] = sweeps.find(([picture]) => picture === path) ?? assert.fail(`${path} is not among the sweeps`);
    for (const word of ['Shows.', 'Edge.', 'Why.']) assert.ok(spans.some((span) => span.kind === 'strong' && span.text === word), `${path}: ${word}`);
  }
});

test('the verdict of a file\'s cases is the worst of theirs', () => {
  const item = (name, ...tallies) => ({ name, results: tallies.map((tally) => ({ tally })) });
  const cases = [item('a/b[x=1]', 'passed', 'passed'), item('a/b[x=2]', 'passed', 'failed'), item('a/bc', 'skipped'), item('a/d', 'passed', 'skipped')];
  assert.deepEqual(casesNamed(cases, 'a/b').map((each) => each.name), ['a/b[x=1]', 'a/b[x=2]']);
  assert.deepEqual(verdictOf(casesNamed(cases, 'a/b')), { tally: 'failed', count: 1, of: 4, first: 'a/b[x=2]' });
  assert.deepEqual(verdictOf(casesNamed(cases, 'a/bc')), { tally: 'skipped', count: 1, of: 1, first: 'a/bc' });
  assert.deepEqual(verdictOf(casesNamed(cases, 'a/d')), { tally: 'passed', count: 1, of: 2, first: 'a/d' });
  assert.equal(verdictOf(casesNamed(cases, 'a')), null);
});
