// What is drawn over a picture, in its pixels; `scale` is the width of a screen pixel there. Each line has a dark twin,
// so that it shows on any picture.

function strokeTwice(context, scale, color, width, path) {
  for (const [style, extra] of [['rgba(0,0,0,0.75)', 2], [color, 0]]) {
    context.strokeStyle = style;
    context.lineWidth = (width + extra) * scale;
    context.beginPath();
    path();
    context.stroke();
  }
}

/** The pixel that is looked at: a square. The worst one: a circle with a cross hair. */
export function drawMarker(context, x, y, kind, scale) {
  const reach = Math.max(0.5, 5 * scale);
  if (kind === 'pixel') {
    strokeTwice(context, scale, '#ffffff', 1.5, () => context.rect(x + 0.5 - reach, y + 0.5 - reach, 2 * reach, 2 * reach));
    return;
  }
  const radius = Math.max(0.9, 9 * scale);
  strokeTwice(context, scale, '#ff5a3c', 1.5, () => {
    context.arc(x + 0.5, y + 0.5, radius, 0, 2 * Math.PI);
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(x + 0.5 + dx * radius, y + 0.5 + dy * radius);
      context.lineTo(x + 0.5 + dx * radius * 1.6, y + 0.5 + dy * radius * 1.6);
    }
  });
}

const hatchTiles = new Map();

function hatchPattern(context, isFalling) {
  if (!hatchTiles.has(isFalling)) {
    const canvas = new OffscreenCanvas(8, 8);
    const tile = canvas.getContext('2d');
    for (const [style, shift] of [['rgba(0,0,0,0.55)', 0], ['rgba(255,255,255,0.5)', 1]]) {
      tile.strokeStyle = style;
      tile.lineWidth = 1;
      tile.beginPath();
      for (const start of [-8, 0, 8]) {
        tile.moveTo(start + shift, isFalling ? 0 : 8);
        tile.lineTo(start + 8 + shift, isFalling ? 8 : 0);
      }
      tile.stroke();
    }
    hatchTiles.set(isFalling, canvas);
  }
  return context.createPattern(hatchTiles.get(isFalling), 'repeat');
}

/**
 * Hatches the pixels where the mask is 0: rising for those that are not compared, falling for those that cannot be
 * decided. The hatching keeps its size on the screen.
 */
export function drawHatch(context, { mask, width, height }, scale, isFalling = false) {
  context.save();
  context.beginPath();
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      if (mask[y * width + x]) continue;
      let end = x + 1;
      while (end < width && !mask[y * width + end]) ++end;
      context.rect(x, y, end - x, 1);
      x = end;
    }
  }
  context.clip();
  const pattern = hatchPattern(context, isFalling);
  pattern.setTransform(new DOMMatrix([scale, 0, 0, scale, 0, 0]));
  context.fillStyle = pattern;
  context.fillRect(0, 0, width, height);
  context.restore();
}

/** The cells of one pyramid level. */
export function drawGrid(context, { width, height }, level, scale) {
  const cell = 2 ** level;
  if (cell < 4 * scale) return; // closer than four screen pixels says nothing
  context.strokeStyle = 'rgba(255,255,255,0.45)';
  context.lineWidth = scale;
  context.beginPath();
  for (let x = 0; x <= width; x += cell) {
    context.moveTo(x, 0);
    context.lineTo(x, height);
  }
  for (let y = 0; y <= height; y += cell) {
    context.moveTo(0, y);
    context.lineTo(width, y);
  }
  context.stroke();
}

const kRayColors = ['#7cf7ff', '#ffd166'];

function strokeSign(context, scale, color, [x, y], kind, reach) {
  strokeTwice(context, scale, color, kind === 'start' || kind === 'hit' || kind === 'end' ? 2 : 1.25, () => {
    if (kind === 'hit') context.arc(x, y, reach, 0, 2 * Math.PI);
    else if (kind === 'start') {
      context.moveTo(x, y - reach);
      for (const [dx, dy] of [[1, 0], [0, 1], [-1, 0], [0, -1]]) context.lineTo(x + dx * reach, y + dy * reach);
    } else if (kind === 'cell') context.rect(x - reach, y - reach, 2 * reach, 2 * reach);
    else {
      for (const [dx, dy] of [[1, 1], [1, -1]]) {
        context.moveTo(x - dx * reach, y - dy * reach);
        context.lineTo(x + dx * reach, y + dy * reach);
      }
    }
  });
}

// The cells that the march looked at, each once, faintly; that of the chosen step over them.
function drawCells(context, record, step, color, scale) {
  const cells = new Map(record.steps.map((each) => [`${each.level} ${each.cell}`, each]));
  const path = ({ level, cell, cellSize }) => context.rect(cell[0] * 2 ** level, cell[1] * 2 ** level, ...cellSize);
  context.strokeStyle = color;
  context.globalAlpha = 0.35;
  context.lineWidth = scale;
  context.beginPath();
  cells.forEach(path);
  context.stroke();
  context.globalAlpha = 1;
  if (record.steps[step]) strokeTwice(context, scale, color, 1, () => path(record.steps[step]));
}

// Numbers of levels beside the steps, where they do not lie on one another.
function writeLevels(context, record, color, scale) {
  context.font = `${10 * scale}px sans-serif`;
  let last = null;
  for (const { positionSS: [x, y], level } of record.steps) {
    if (last && Math.hypot(x - last[0], y - last[1]) < 16 * scale) continue;
    last = [x, y];
    context.lineWidth = 3 * scale;
    context.strokeStyle = 'rgba(0,0,0,0.8)';
    context.fillStyle = color;
    context.strokeText(String(level), x + 5 * scale, y - 4 * scale);
    context.fillText(String(level), x + 5 * scale, y - 4 * scale);
  }
}

/**
 * The way of a traced ray on screen: start, each step with its level and kind, the cells that it looked at, the end. One
 * colour a backend, the second one dashed.
 */
export function drawTrace(context, trace, step, scale) {
  trace.backends.forEach((record, i) => {
    if (!record.traced) return;
    const color = kRayColors[i];
    if (i === 0) drawCells(context, record, step, color, scale);
    context.setLineDash(i === 0 ? [] : [5 * scale, 4 * scale]);
    strokeTwice(context, scale, color, 1.5, () => {
      context.moveTo(...record.startSS);
      for (const { positionSS } of record.steps) context.lineTo(...positionSS);
      context.lineTo(...record.endSS);
    });
    context.setLineDash([]);
    context.fillStyle = color;
    for (const [index, { positionSS, intersection }] of record.steps.entries()) {
      const reach = (index === step ? 4.5 : 2) * scale;
      if (intersection === 'cell') strokeSign(context, scale, color, positionSS, 'cell', reach);
      else {
        context.beginPath();
        context.arc(...positionSS, reach, 0, 2 * Math.PI);
        context.fill();
      }
    }
    if (i === 0) writeLevels(context, record, color, scale);
    strokeSign(context, scale, color, record.startSS, 'start', 5 * scale);
    strokeSign(context, scale, color, record.endSS, record.hitSuccess === 'hit' ? 'hit' : 'end', 5 * scale);
  });
}
