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

let hatchTile = null;

function hatchPattern(context) {
  if (!hatchTile) {
    hatchTile = new OffscreenCanvas(8, 8);
    const tile = hatchTile.getContext('2d');
    for (const [style, shift] of [['rgba(0,0,0,0.55)', 0], ['rgba(255,255,255,0.5)', 1]]) {
      tile.strokeStyle = style;
      tile.lineWidth = 1;
      tile.beginPath();
      for (const start of [-8, 0, 8]) {
        tile.moveTo(start + shift, 8);
        tile.lineTo(start + 8 + shift, 0);
      }
      tile.stroke();
    }
  }
  return context.createPattern(hatchTile, 'repeat');
}

/** Hatches the pixels that are not compared. The hatching keeps its size on the screen. */
export function drawHatch(context, { mask, width, height }, scale) {
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
  const pattern = hatchPattern(context);
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

/** The way of a traced ray on screen: start, steps, the cell of the chosen step, end. One colour a backend. */
export function drawTrace(context, trace, step, scale) {
  trace.backends.forEach((record, i) => {
    if (!record.traced) return;
    const color = kRayColors[i];
    const chosen = record.steps[step];
    if (chosen) {
      const side = 2 ** chosen.level;
      const [x, y] = chosen.cell;
      strokeTwice(context, scale, color, 1, () => context.rect(x * side, y * side, ...chosen.cellSize));
    }
    strokeTwice(context, scale, color, 1.5, () => {
      context.moveTo(...record.startSS);
      for (const { positionSS } of record.steps) context.lineTo(...positionSS);
      context.lineTo(...record.endSS);
    });
    context.fillStyle = color;
    for (const [index, { positionSS }] of record.steps.entries()) {
      context.beginPath();
      context.arc(...positionSS, (index === step ? 4.5 : 2) * scale, 0, 2 * Math.PI);
      context.fill();
    }
    const hit = record.hitSuccess === 'hit';
    strokeTwice(context, scale, color, 2, () => {
      const [x, y] = record.endSS;
      const reach = 5 * scale;
      if (hit) context.arc(x, y, reach, 0, 2 * Math.PI);
      else {
        context.moveTo(x - reach, y - reach);
        context.lineTo(x + reach, y + reach);
        context.moveTo(x - reach, y + reach);
        context.lineTo(x + reach, y - reach);
      }
    });
  });
}
