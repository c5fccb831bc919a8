// Where a page's data come from. A piece is in the file itself, or in data/NAME.js beside it: a script that is added
// when the piece is asked for, since a page from disk may read its siblings in no other way. In the inspector it comes
// from the server.
import { Plane, unpackFloats } from 'crossray/planes.js';

const pieces = new Map(); // name -> promise of its value
const waiting = new Map(); // name -> what to call when its script has run

globalThis.crossrayData = (name, value) => waiting.get(name)?.(value);

function addScript(name) {
  return new Promise((resolve, reject) => {
    const script = document.createElement('script');
    waiting.set(name, resolve);
    script.onerror = () => reject(new Error(`data/${name}.js cannot be read: is it beside index.html?`));
    script.onload = () => script.remove();
    script.src = `data/${encodeURIComponent(name)}.js`;
    document.head.append(script);
  }).finally(() => waiting.delete(name));
}

let fetchPiece = addScript;

/** Pieces that are not in the page come from `fetch(name)` from now on. */
export function takePiecesFrom(fetch) {
  fetchPiece = fetch;
}

/** The value of a piece; the same promise for each call. */
export function loadPiece(name) {
  if (!pieces.has(name)) {
    const inlined = document.getElementById(`data-${name}`);
    pieces.set(name, inlined ? Promise.resolve(JSON.parse(inlined.textContent)) : fetchPiece(name));
  }
  return pieces.get(name);
}

/** A case's pieces are not asked for again: a newer rendering has taken their place. */
export function forgetPieces(item) {
  for (const name of [item.details, ...Object.values(item.planes ?? {})]) pieces.delete(name);
}

/** The index is always in the page. */
export function readIndex() {
  return JSON.parse(document.getElementById('data-index').textContent);
}

/** A case's part of run.json, or null where the report has left it out. */
export async function loadDetails(item) {
  if (item.details === '') return null;
  const list = await loadPiece(item.details);
  return list.find((each) => each.name === item.name) ?? null;
}

const unpacked = new WeakMap(); // entry of a piece -> promise of its floats

async function floatsOf(item, entry, depth = 0) {
  if (entry.floats) return entry.floats; // they came unpacked
  if (!unpacked.has(entry)) {
    unpacked.set(entry, entry.data !== undefined ? unpackFloats(entry.data) : (async () => {
      const other = await loadPiece(item.planes[entry.same]);
      const twin = other.planes.find((each) => each.name === entry.name);
      if (!twin || depth > 8) throw new Error(`the plane ${entry.name} of ${entry.same} is missing`);
      return floatsOf(item, twin, depth + 1);
    })());
  }
  return unpacked.get(entry);
}

/** The planes of a backend, or of "expected"; none where the run or the report kept none. */
export async function loadPlanes(item, source) {
  const name = item.planes?.[source];
  if (name === undefined) return [];
  const piece = await loadPiece(name);
  return Promise.all(piece.planes.map(async (entry) => {
    const plane = new Plane(entry.name, piece.width, piece.height, entry.channels, await floatsOf(item, entry));
    plane.same = entry.same; // the backend that gave the same bits
    return plane;
  }));
}
