// The documents of the atlas as a tree: the part of Markdown that they are written in. No document object here: node tests
// this file, against the documents themselves.

/** `../cases/a.toml` beside `docs/stability.md` is `cases/a.toml`. */
export function resolvePath(document, link) {
  const parts = document.split('/').slice(0, -1);
  for (const part of link.replace(/#.*$/, '').split('/')) {
    if (part === '..') parts.pop();
    else if (part !== '.' && part !== '') parts.push(part);
  }
  return parts.join('/');
}

const kSpan = /\[([^\]]+)\]\(([^)]+)\)|\*\*([^*]+)\*\*|`([^`]+)`|\*([^*\s](?:[^*]*[^*\s])?)\*/g;

/** [{kind: 'text'|'strong'|'em'|'code'|'link', text, path}]; the path of a link from the top of the repository. */
export function parseSpans(text, document) {
  const spans = [];
  let at = 0;
  const addText = (part) => part !== '' && spans.push({ kind: 'text', text: part });
  for (const match of text.matchAll(kSpan)) {
    addText(text.slice(at, match.index));
    at = match.index + match[0].length;
    if (match[1] !== undefined) spans.push({ kind: 'link', text: match[1].replaceAll('`', ''), path: resolvePath(document, match[2]) });
    else if (match[3] !== undefined) spans.push({ kind: 'strong', text: match[3] });
    else spans.push(match[4] !== undefined ? { kind: 'code', text: match[4] } : { kind: 'em', text: match[5] });
  }
  addText(text.slice(at));
  return spans;
}

const cellsOf = (line) => line.replace(/^\||\|$/g, '').split('|').map((cell) => cell.trim());

// What a line begins. A block takes all lines until an empty one, a paragraph until a line of another kind.
function kindOf(line) {
  if (line.startsWith('|')) return 'table';
  if (line.startsWith('- ')) return 'list';
  return /^!\[[^\]]*\]\([^)]+\)$/.test(line) ? 'picture' : 'paragraph';
}

function parseBlock(lines, document) {
  const kind = kindOf(lines[0]);
  if (kind === 'table') {
    const [head, , ...rows] = lines.map(cellsOf);
    return { kind, head, rows: rows.map((cells) => cells.map((cell) => parseSpans(cell, document))) };
  }
  if (kind === 'list') {
    const items = [];
    for (const line of lines) {
      if (line.startsWith('- ')) items.push(line.slice(2));
      else items[items.length - 1] += ` ${line.trim()}`;
    }
    return { kind, items: items.map((item) => parseSpans(item, document)) };
  }
  if (kind === 'picture') {
    const [, text, link] = lines[0].match(/^!\[([^\]]*)\]\(([^)]+)\)$/);
    return { kind, text, path: resolvePath(document, link) };
  }
  return { kind, spans: parseSpans(lines.join(' '), document) };
}

/** Sections by their headings, the first of them what stands before any: [{id, title, blocks}]. */
export function parseDocument(text, document) {
  const sections = [];
  let block = [];
  const endBlock = () => {
    if (block.length > 0) sections.at(-1).blocks.push(parseBlock(block, document));
    block = [];
  };
  for (const line of text.split('\n')) {
    const heading = line.match(/^#+ (.*)$/);
    if (heading) {
      endBlock();
      const id = heading[1].toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '');
      sections.push({ id, title: heading[1], blocks: [] });
    } else if (line.trim() === '') endBlock();
    else {
      if (block.length > 0 && kindOf(block[0]) === 'paragraph' && kindOf(line) !== 'paragraph') endBlock();
      block.push(line);
    }
  }
  endBlock();
  return sections;
}

/** All spans of a section, in its order. */
export function spansOf({ blocks }) {
  return blocks.flatMap((block) => block.spans ?? block.items?.flat() ?? block.rows?.flat(2) ?? []);
}

/** A row of the atlas proper: situation, where, how it fails, what is returned, instead, seen in. */
export const isAtlasTable = (block) => block.kind === 'table' && block.head.length === 6 && block.head[1] === 'where';

const kCase = /^cases\/(.+)\.toml$/;
const kPicture = /\.(svg|png)$/;

export const isPicture = (path) => kPicture.test(path);

/** The name of the case that a path is the file of, or null. */
export const caseNameOf = (path) => path.match(kCase)?.[1] ?? null;

/** The name that all cases of a file begin with. */
export const fileNameOf = (name) => name.replace(/\[.*/s, '');

/** The cases of a run that a name means: itself, or what its file expands to. */
export function casesNamed(cases, name) {
  return cases.filter((item) => fileNameOf(item.name) === name);
}

/**
 * What a run says of some cases: {tally, count, of, first}. `count` of all their results are of that tally, the worst
 * there is; `first` is the case to look at. Null where the run has none of them.
 */
export function verdictOf(cases) {
  if (cases.length === 0) return null;
  const results = cases.flatMap((item) => item.results.map((result) => ({ item, tally: result.tally })));
  const ofTally = (tally) => results.filter((result) => result.tally === tally);
  const tally = ofTally('failed').length > 0 ? 'failed' : ofTally('passed').length > 0 ? 'passed' : 'skipped';
  const found = ofTally(tally);
  return { tally, count: found.length, of: results.length, first: (found[0]?.item ?? cases[0]).name };
}
