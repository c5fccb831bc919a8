// The pictures under one shared zoom and pan. A pane is a canvas; its picture is drawn once into an image of the plane's
// size and then scaled, so that moving about costs nothing.
import { h, redraw } from 'crossray/dom.js';
import { drawGrid, drawHatch, drawMarker, drawTrace } from 'crossray/overlays.js';

const kMaxZoom = 128;
const kCaption = 48; // screen pixels above and between the pictures

/**
 * `hooks`: {get state, update(patch), pick(x, y)}. show(panes) takes [{key, title, facts, bytes, width, height, mask,
 * isDifference}] and draws them as the layout says.
 */
export function createPanes(box, hooks) {
  let panes = [];
  let overlay = {}; // {worst: [x, y], pixel: [x, y], trace, step}
  let blinkOn = false;
  let blinkTimer = 0;
  let shiftHeld = false;
  let frame = 0;

  const size = () => (panes[0] ? [panes[0].width, panes[0].height] : [1, 1]);

  function imageOf(pane) {
    const image = new OffscreenCanvas(pane.width, pane.height);
    image.getContext('2d').putImageData(new ImageData(pane.bytes, pane.width, pane.height), 0, 0);
    return image;
  }

  function transform(canvas) {
    const { z, cx, cy } = hooks.state();
    const [width, height] = size();
    const fit = Math.min(canvas.clientWidth / width, canvas.clientHeight / height);
    const zoom = z > 0 ? z : fit;
    const [x, y] = z > 0 ? [cx * width, cy * height] : [width / 2, height / 2];
    return { zoom, left: canvas.clientWidth / 2 - x * zoom, top: canvas.clientHeight / 2 - y * zoom };
  }

  function pixelAt(canvas, event) {
    const { zoom, left, top } = transform(canvas);
    const bounds = canvas.getBoundingClientRect();
    return [(event.clientX - bounds.left - left) / zoom, (event.clientY - bounds.top - top) / zoom];
  }

  function zoomAt(canvas, event, factor) {
    const { zoom } = transform(canvas);
    const [width, height] = size();
    const [x, y] = event ? pixelAt(canvas, event) : [hooks.state().cx * width, hooks.state().cy * height];
    const next = Math.min(kMaxZoom, Math.max(0.25, zoom * factor));
    const bounds = canvas.getBoundingClientRect();
    const dx = event ? event.clientX - bounds.left - canvas.clientWidth / 2 : 0;
    const dy = event ? event.clientY - bounds.top - canvas.clientHeight / 2 : 0;
    hooks.update({ z: next, cx: (x - dx / next) / width, cy: (y - dy / next) / height });
  }

  // Drag moves, a click picks.
  function listen(canvas) {
    let start = null;
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      zoomAt(canvas, event, Math.exp(-event.deltaY * 0.0016));
    }, { passive: false });
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      const at = transform(canvas);
      start = { x: event.clientX, y: event.clientY, at, moved: false };
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!start && hooks.state().follow) pick(canvas, event);
      if (!start) return;
      const [dx, dy] = [event.clientX - start.x, event.clientY - start.y];
      if (Math.hypot(dx, dy) > 3) start.moved = true;
      if (!start.moved) return;
      const [width, height] = size();
      const { zoom, left, top } = start.at;
      hooks.update({
        z: zoom,
        cx: (canvas.clientWidth / 2 - left - dx) / zoom / width,
        cy: (canvas.clientHeight / 2 - top - dy) / zoom / height,
      });
    });
    canvas.addEventListener('pointerup', (event) => {
      if (start && !start.moved) pick(canvas, event);
      start = null;
    });
    canvas.addEventListener('dblclick', () => hooks.update({ z: 0, cx: 0.5, cy: 0.5 }));
  }

  function pick(canvas, event) {
    const [x, y] = pixelAt(canvas, event).map(Math.floor);
    const [width, height] = size();
    if (x >= 0 && y >= 0 && x < width && y < height) hooks.pick(x, y);
  }

  function paint(canvas, layers) {
    const ratio = devicePixelRatio || 1;
    const [w, hgt] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (w === 0 || hgt === 0) return; // not on screen
    if (canvas.width !== w || canvas.height !== hgt) Object.assign(canvas, { width: w, height: hgt });
    const context = canvas.getContext('2d');
    const { zoom, left, top } = transform(canvas);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, w, hgt);
    context.setTransform(ratio * zoom, 0, 0, ratio * zoom, ratio * left, ratio * top);
    context.imageSmoothingEnabled = zoom < 1;
    for (const { pane, alpha = 1, from = 0, to = 1 } of layers) {
      pane.image ??= imageOf(pane);
      const [x0, x1] = [from * pane.width, to * pane.width];
      context.globalAlpha = alpha;
      context.drawImage(pane.image, x0, 0, x1 - x0, pane.height, x0, 0, x1 - x0, pane.height);
    }
    context.globalAlpha = 1;
    const state = hooks.state();
    const top0 = layers[layers.length - 1].pane;
    const scale = 1 / zoom;
    if (state.hatch && top0.mask) drawHatch(context, top0, scale);
    if (state.hatch && top0.decidable) drawHatch(context, { ...top0, mask: top0.decidable }, scale, true);
    if (state.grid >= 0) drawGrid(context, top0, state.grid, scale);
    if (overlay.trace) drawTrace(context, overlay.trace, overlay.step, scale);
    if (state.worst && overlay.worst) drawMarker(context, ...overlay.worst, 'worst', scale);
    if (overlay.pixel) drawMarker(context, ...overlay.pixel, 'pixel', scale);
    if (layers[0].to < 1) {
      context.fillStyle = '#ffffff';
      context.fillRect(layers[0].to * top0.width - scale, 0, 2 * scale, top0.height);
    }
  }

  const find = (key) => panes.find((pane) => pane.key === key);

  // What each canvas shows, from the back to the front.
  function layersOf(pane) {
    const { layout, split } = hooks.state();
    const expected = find('against');
    const actual = find('actual');
    if (shiftHeld && pane.key === 'actual' && expected) return [{ pane: expected }];
    if (pane.key !== 'both') return [{ pane }];
    if (layout === 'slider') return [{ pane: expected, to: split }, { pane: actual, from: split }];
    if (layout === 'onion') return [{ pane: expected }, { pane: actual, alpha: split }];
    return [{ pane: (blinkOn || shiftHeld) ? expected : actual }];
  }

  // As many columns as show the pictures largest.
  function layOut() {
    const count = box.querySelectorAll('figure').length;
    if (count === 0) return;
    const [width, height] = size();
    const scale = (columns) => Math.min(box.clientWidth / columns / width, (box.clientHeight / Math.ceil(count / columns) - kCaption) / height);
    let best = 1;
    for (let columns = 2; columns <= count; ++columns) if (scale(columns) > scale(best)) best = columns;
    box.style.gridTemplateColumns = `repeat(${best}, minmax(0, 1fr))`;
  }

  function drawNow() {
    frame = 0;
    layOut();
    for (const figure of box.querySelectorAll('figure')) {
      const pane = figure.pane;
      const layers = layersOf(pane);
      paint(figure.querySelector('canvas'), layers);
      const shown = figure.querySelector('.shown');
      if (shown) shown.textContent = pane.key === 'both' && hooks.state().layout === 'blink' ? layers[0].pane.title : '';
      if (pane.key === 'actual') figure.querySelector('.title').textContent = layers[0].pane.title;
    }
  }

  function draw() {
    if (!frame) frame = requestAnimationFrame(drawNow);
  }

  function makeFigure(pane) {
    const canvas = h('canvas', { tabindex: '0', role: 'img', 'aria-label': `${pane.title}${pane.facts ? `, ${pane.facts}` : ''}` });
    listen(canvas);
    const figure = h('figure', { class: `pane ${pane.key}` },
      h('figcaption', {},
        h('div', {}, h('span', { class: 'title' }, pane.title), pane.key === 'both' && h('span', { class: 'shown' })),
        h('div', { class: pane.isLoud ? 'facts loud' : 'facts' }, pane.facts ?? '')),
      canvas);
    figure.pane = pane;
    return figure;
  }

  function figuresFor() {
    const { layout, split } = hooks.state();
    const expected = find('against');
    const actual = find('actual');
    const difference = find('difference');
    if (layout === 'difference' && difference) return [makeFigure(difference)];
    if (layout === 'side' || !expected || !actual) return panes.map(makeFigure);
    const both = { key: 'both', title: layout === 'blink' ? 'in turn:' : `${expected.title} | ${actual.title}`, facts: `${expected.facts} | ${actual.facts}`, isLoud: expected.isLoud || actual.isLoud, width: actual.width, height: actual.height };
    const figure = makeFigure(both);
    if (layout !== 'blink') {
      const slider = h('input', { type: 'range', min: '0', max: '1', step: '0.005', value: String(split),
        'aria-label': layout === 'slider' ? 'Where the two meet' : 'Share of the actual picture', class: 'split' });
      slider.addEventListener('input', () => hooks.update({ split: Number(slider.value) }));
      figure.append(slider);
    }
    return difference ? [figure, makeFigure(difference)] : [figure];
  }

  function arrange() {
    clearInterval(blinkTimer);
    if (hooks.state().layout === 'blink') {
      blinkTimer = setInterval(() => {
        blinkOn = !blinkOn;
        draw();
      }, 600);
    }
    const figures = figuresFor();
    redraw(box, figures);
    draw();
  }

  new ResizeObserver(draw).observe(box);

  return {
    show(next) {
      panes = next;
      arrange();
    },
    message(...content) {
      panes = [];
      clearInterval(blinkTimer);
      box.style.gridTemplateColumns = '';
      box.replaceChildren(h('div', { class: 'message' }, ...content));
    },
    setOverlay(next) {
      overlay = next;
      draw();
    },
    holdShift(held) {
      if (held === shiftHeld) return;
      shiftHeld = held;
      draw();
    },
    zoomBy(factor) {
      const canvas = box.querySelector('canvas');
      if (canvas) zoomAt(canvas, null, factor);
    },
    arrange,
    draw,
  };
}
