// The atlas: for each method where it fails, how, what it returns there and what to use instead. The text is the
// document's own (docs/stability.md); beside each case stands what this run found of it, beside each claim its curve.
import { caseNameOf, casesNamed, isAtlasTable, isPicture, parseDocument, spansOf, verdictOf } from 'crossray/atlas_text.js';
import { loadPiece } from 'crossray/data.js';
import { h, say, verdictMark } from 'crossray/dom.js';
import { openDialog } from 'crossray/keys.js';
import { unpackBytes } from 'crossray/planes.js';

const kMarks = { failed: 'fail', passed: 'pass', skipped: 'skip' };

// Of sweeps: what their page says of each, by its picture.
function readSweeps({ name, text }) {
  const found = new Map();
  for (const section of parseDocument(text, name)) {
    const picture = section.blocks.find((block) => block.kind === 'picture');
    if (picture) found.set(picture.path, { title: section.title, blocks: section.blocks.filter((block) => block !== picture) });
  }
  return found;
}

async function unpackPictures(piece) {
  const entries = await Promise.all(Object.entries(piece).map(async ([path, { type, data }]) =>
    [path, URL.createObjectURL(new Blob([await unpackBytes(data)], { type }))]));
  return new Map(entries);
}

let texts = null; // what was read of the pieces, once: {sections, sweeps, pictures}
let drawn = null; // the run's cases that the page was drawn with
let went = ''; // the place that it was last asked for
let titles = new Map(); // of pictures, by path
let change = null; // changes the state

async function readTexts(index) {
  if (texts) return texts;
  const [document, sweeps] = await loadPiece(index.atlas);
  texts = { sections: parseDocument(document.text, document.name), sweeps: readSweeps(sweeps), pictures: new Map() };
  if (index.atlasPictures) texts.pictures = await unpackPictures(await loadPiece(index.atlasPictures));
  return texts;
}

function tallyText(verdict) {
  if (!verdict) return 'not in this run';
  return `${verdict.tally} ${verdict.count < verdict.of ? `${verdict.count} of ` : ''}${verdict.of}`;
}

function drawVerdict(verdict) {
  if (!verdict) return h('span', { class: 'verdict dim' }, tallyText(null));
  return h('span', { class: `verdict ${verdict.tally}` }, verdictMark(kMarks[verdict.tally], verdict.tally), ` ${tallyText(verdict)}`);
}

// Such a link keeps the rest of the state; its address is for another tab.
const link = (patch, attributes, ...content) => h('a', {
  href: `#page=atlas&${new URLSearchParams(patch)}`, ...attributes,
  onclick: (event) => {
    event.preventDefault();
    change(patch);
  },
}, ...content);
const figureLink = (path, name, ...content) => link({ figure: path }, { class: 'figure-link', 'aria-label': name }, ...content);

function drawCase(name, cases, ...content) {
  const verdict = verdictOf(casesNamed(cases, name));
  return h('span', { class: 'case-link', 'data-case': name }, verdict ? h('a', { href: `#case=${encodeURIComponent(verdict.first)}` }, ...content) : h('span', { title: `cases/${name}.toml` }, ...content),
    ' ', drawVerdict(verdict));
}

function drawSpan(span, cases) {
  if (span.kind === 'strong' || span.kind === 'em') return h(span.kind, {}, span.text);
  if (span.kind === 'code') return casesNamed(cases, span.text).length > 0 ? drawCase(span.text, cases, h('code', {}, span.text)) : h('code', {}, span.text);
  if (span.kind === 'text') return span.text;
  const name = caseNameOf(span.path);
  if (name) return drawCase(name, cases, span.text);
  if (isPicture(span.path)) return drawThumbnail(span);
  return span.text === span.path.split('/').pop() ? h('code', {}, span.path) : [`${span.text}: `, h('code', {}, span.path)];
}

function drawThumbnail({ text, path }) {
  const url = texts.pictures.get(path);
  if (!url) return h('span', { title: path }, text);
  const title = titles.get(path);
  return figureLink(path, `${text}: ${title}`, h('img', { src: url, alt: '', class: path.endsWith('.svg') ? 'chart-picture' : undefined, loading: 'lazy' }), h('span', {}, text));
}

const drawSpans = (spans, cases) => spans.map((span) => drawSpan(span, cases)).flat();

// Situation, where, how it fails, what is returned, instead, seen in.
const kColumns = ['situation', 'where', 'how it fails', 'what is returned', 'instead', 'seen in'];

// Roles are said again: on a narrow page rows are cards, and a table that is laid out otherwise is none.
function drawAtlasTable({ rows }, title, cases) {
  return h('table', { class: 'atlas-table', role: 'table' }, h('caption', { class: 'hidden' }, `Where it fails: ${title}`),
    h('thead', { role: 'rowgroup' }, h('tr', { role: 'row' }, kColumns.map((name) => h('th', { scope: 'col', role: 'columnheader' }, name)))),
    h('tbody', { role: 'rowgroup' }, rows.map((cells) => h('tr', { role: 'row' }, cells.map((spans, i) => {
      // Without the commas between cases, and between pictures.
      const shown = i === 1 || i === 5 ? spans.filter((span) => span.kind !== 'text' || span.text.trim() !== ',') : spans;
      return h('td', { role: 'cell', 'data-column': kColumns[i], class: `c${i}` }, shown.length > 0 ? drawSpans(shown, cases) : null);
    })))));
}

function drawBlock(block, title, cases) {
  if (isAtlasTable(block)) return drawAtlasTable(block, title, cases);
  if (block.kind === 'paragraph') return h('p', {}, drawSpans(block.spans, cases));
  if (block.kind === 'list') return h('ul', {}, block.items.map((spans) => h('li', {}, drawSpans(spans, cases))));
  if (block.kind === 'picture') {
    const url = texts.pictures.get(block.path);
    return url && h('figure', { class: 'atlas-figure' }, figureLink(block.path, `larger: ${block.text}`,
      h('img', { src: url, alt: '', class: block.path.endsWith('.svg') ? 'chart-picture' : undefined, loading: 'lazy' })), h('figcaption', {}, block.text));
  }
  return h('div', { class: 'figures-box', tabindex: '0', role: 'region', 'aria-label': `${title}: table` }, h('table', { class: 'figures' }, h('caption', { class: 'hidden' }, title),
    h('thead', {}, h('tr', {}, block.head.map((name) => h('th', { scope: 'col' }, name)))),
    h('tbody', {}, block.rows.map((cells) => h('tr', {}, cells.map((spans, i) => h(i === 0 ? 'th' : 'td', i === 0 ? { scope: 'row' } : {}, drawSpans(spans, cases))))))));
}

// What the run says of all cases that a section links.
function verdictOfSection(section, cases) {
  const names = new Set(spansOf(section).filter((span) => span.kind === 'link').map((span) => caseNameOf(span.path)).filter(Boolean));
  return { verdict: verdictOf([...names].flatMap((name) => casesNamed(cases, name))), names: names.size };
}

// To a section, or to the first line that links a case: "case:NAME".
function goTo(box, at) {
  for (const row of box.querySelectorAll('.shown')) row.classList.remove('shown');
  const link = at.startsWith('case:') && box.querySelector(`[data-case="${CSS.escape(at.slice(5))}"] a`);
  const place = link ? link.closest('tr, li, p') : at && box.querySelector(`#at-${CSS.escape(at)}`);
  if (!place) return;
  if (link) place.classList.add('shown');
  place.scrollIntoView({ block: link ? 'center' : 'start' });
  (link || place).focus({ preventScroll: true });
}

function drawContents(sections, cases) {
  return h('nav', { class: 'atlas-contents', 'aria-label': 'Methods' }, h('ul', {}, sections.map((section) => {
    const { verdict, names } = verdictOfSection(section, cases);
    return h('li', {}, link({ at: section.id }, {}, section.title), names > 0 && ' ', names > 0 && drawVerdict(verdict));
  })));
}

const commandOf = ({ blocks }) => blocks.flatMap((block) => block.spans ?? []).find((span) => span.kind === 'code' && span.text.startsWith('crossray sweep '));

/** A picture with what is said of it, over the page. */
function openFigure(path, { index, state, update }) {
  const url = texts.pictures.get(path);
  if (!url) return say(`the atlas has no picture ${path}`);
  const sweep = texts.sweeps.get(path);
  const swept = sweep && commandOf(sweep)?.text.split(' ')[2];
  openDialog(sweep?.title ?? titles.get(path), h('img', { src: url, class: path.endsWith('.svg') ? 'large chart-picture' : 'large', alt: sweep ? `Curves of ${sweep.title}` : titles.get(path) }),
    ...(swept ? [h('p', {}, 'Case: ', drawCase(swept, index.cases, swept))] : []), ...(sweep?.blocks ?? []).map((block) => drawBlock(block, sweep.title, index.cases)),
    h('p', { class: 'dim' }, h('code', {}, path)));
  const dialog = document.getElementById('dialog');
  const closeWithAddress = () => state().figure === '' && dialog.close(); // a link was followed, or the way back
  addEventListener('hashchange', closeWithAddress);
  dialog.addEventListener('close', () => {
    removeEventListener('hashchange', closeWithAddress);
    update({ figure: '' });
  }, { once: true });
}

// What a picture is called: by its sweep, by its caption, else by its row.
function nameTitles({ sections, sweeps }) {
  const named = new Map();
  for (const section of sections) {
    for (const block of section.blocks) {
      if (block.kind === 'picture') named.set(block.path, block.text);
      for (const row of isAtlasTable(block) ? block.rows : []) {
        for (const { kind, path } of row[5]) if (kind === 'link' && !named.has(path)) named.set(path, `${section.title}: ${row[1].filter((span) => span.kind === 'link').map((span) => span.text).join(', ')}`);
      }
    }
  }
  for (const [path, { title }] of sweeps) named.set(path, title);
  return named;
}

/** Fills the page of the atlas. It is drawn once for the cases of a run; later calls go to a place or open a figure. */
export async function drawAtlas(box, { index, state, update }) {
  try {
    await readTexts(index);
  } catch (error) {
    return void box.replaceChildren(h('p', {}, error.message));
  }
  if (drawn !== index.cases) {
    drawn = index.cases;
    titles = nameTitles(texts);
    change = (patch) => {
      if (patch.at === state().at) goTo(box, patch.at);
      update(patch);
    };
    const [head, ...sections] = texts.sections;
    const heading = (section) => h('h3', { id: `at-${section.id}`, tabindex: '-1' }, section.title);
    box.replaceChildren(h('h2', {}, head.title), h('button', { type: 'button', class: 'small', onclick: () => update({ page: '' }) }, 'back to the case'),
      drawContents(sections, index.cases), ...head.blocks.map((block) => drawBlock(block, head.title, index.cases)),
      ...sections.map((section) => h('section', { class: 'atlas-section', 'aria-labelledby': `at-${section.id}` }, heading(section), section.blocks.map((block) => drawBlock(block, section.title, index.cases)))));
    goTo(box, state().at);
    went = state().at;
  } else if (went !== state().at) goTo(box, went = state().at);
  if (state().figure && !document.getElementById('dialog').open) openFigure(state().figure, { index, state, update });
}
