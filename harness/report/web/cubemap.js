// A cubemap from within: a perspective view that the mouse turns, with its levels and a brightness.
import { nanColor, encodeSrgb } from 'crossray/colors.js';
import { loadPiece } from 'crossray/data.js';
import { h, redraw } from 'crossray/dom.js';
import { formatFloat } from 'crossray/numbers.js';
import { Plane, unpackFloats } from 'crossray/planes.js';

const kFaces = ['+x', '-x', '+y', '-y', '+z', '-z'];

/**
 * The face, column and row of a level that a direction points to, by the cube map table of OpenGL and Vulkan
 * (harness/scene/cubemap.h). Of equal components z wins over y, and y over x.
 */
export function findTexel([x, y, z], size) {
  const [ax, ay, az] = [Math.abs(x), Math.abs(y), Math.abs(z)];
  let face;
  let s;
  let t;
  let major;
  if (az >= ax && az >= ay) [face, s, t, major] = z < 0 ? [5, -x, -y, az] : [4, x, -y, az];
  else if (ay >= ax) [face, s, t, major] = y < 0 ? [3, x, -z, ay] : [2, x, z, ay];
  else [face, s, t, major] = x < 0 ? [1, z, -y, ax] : [0, -z, -y, ax];
  const place = (v) => Math.min(size - 1, Math.max(0, Math.floor((v / major + 1) * 0.5 * size)));
  return { face, x: place(s), y: place(t) };
}

/** The direction of a place of the view, -1 to 1 to the right and up; yaw and pitch in degrees, yaw 0 looks along -z. */
export function viewDirection(right, up, { yaw, pitch, fov }) {
  const scale = Math.tan((fov * Math.PI) / 360);
  const [sy, cy] = [Math.sin((yaw * Math.PI) / 180), Math.cos((yaw * Math.PI) / 180)];
  const [sp, cp] = [Math.sin((pitch * Math.PI) / 180), Math.cos((pitch * Math.PI) / 180)];
  const [x, y] = [right * scale, up * scale];
  const [py, pz] = [y * cp + sp, y * sp - cp]; // pitched
  return [x * cy - pz * sy, py, pz * cy + x * sy];
}

function drawView(image, plane, view, gain) {
  const [width, height] = [image.width, image.height];
  for (let row = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column) {
      const direction = viewDirection((2 * column + 1) / width - 1, 1 - (2 * row + 1) / height, view);
      const texel = findTexel(direction, plane.width);
      const at = (texel.face * plane.width + texel.y) * plane.width + texel.x;
      const offset = (row * width + column) * 4;
      for (let channel = 0; channel < 3; ++channel) {
        const value = plane.data[channel * plane.pixels + at];
        image.data[offset + channel] = Number.isNaN(value) ? nanColor[channel] : encodeSrgb(value * gain) * 255;
      }
      image.data[offset + 3] = 255;
    }
  }
}

const levels = new Map(); // "piece level" -> promise of a plane

function loadLevel(piece, level) {
  const key = `${piece} ${level}`;
  if (!levels.has(key)) {
    levels.set(key, loadPiece(piece).then(async ({ size, levels: list }) => {
      const side = Math.max(1, size >> level);
      return new Plane(`level ${level}`, side, 6 * side, 3, await unpackFloats(list[level]));
    }));
  }
  return levels.get(key);
}

function slider(label, value, { min, max, step }, change) {
  const shown = h('output', {}, String(value));
  return h('label', { class: 'control range' }, label, h('input', { type: 'range', min, max, step, value, oninput: (event) => {
    shown.textContent = event.target.value;
    change(Number(event.target.value));
  } }), shown);
}

/** Fills the page of cubemaps. State: cube (its name), yaw, pitch, fov, mip, glow (stops). */
export async function drawCubemaps(box, { index, state, update }) {
  const cube = index.cubemaps.find((each) => each.name === state().cube) ?? index.cubemaps[0];
  const piece = await loadPiece(cube.piece);
  const canvas = h('canvas', { width: 480, height: 480, class: 'cube', tabindex: '0', role: 'img',
    'aria-label': `${cube.name} from within; arrow keys turn it` });
  const readout = h('p', { class: 'number', role: 'status' }, 'Drag turns, the wheel zooms, arrows turn by 15 degrees.');
  const context = canvas.getContext('2d');
  const image = context.createImageData(480, 480);
  let frame = 0;
  const draw = async () => {
    frame = 0;
    const plane = await loadLevel(cube.piece, Math.min(state().mip, piece.levels.length - 1));
    drawView(image, plane, state(), 2 ** state().glow);
    context.putImageData(image, 0, 0);
  };
  const change = (patch) => {
    update(patch);
    if (!frame) frame = requestAnimationFrame(draw);
  };
  const turn = (yaw, pitch) => change({ yaw: ((state().yaw + yaw + 540) % 360) - 180, pitch: Math.min(89, Math.max(-89, state().pitch + pitch)) });
  let start = null;
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    start = event;
  });
  canvas.addEventListener('pointerup', () => (start = null));
  canvas.addEventListener('pointermove', async (event) => {
    if (start) {
      const perPixel = state().fov / canvas.clientWidth;
      turn((start.clientX - event.clientX) * perPixel, (event.clientY - start.clientY) * perPixel);
      start = event;
    }
    const bounds = canvas.getBoundingClientRect();
    const direction = viewDirection((2 * (event.clientX - bounds.left)) / bounds.width - 1, 1 - (2 * (event.clientY - bounds.top)) / bounds.height, state());
    const plane = await loadLevel(cube.piece, Math.min(state().mip, piece.levels.length - 1));
    const texel = findTexel(direction, plane.width);
    const value = plane.pixel(texel.x, texel.face * plane.width + texel.y);
    readout.textContent = `${kFaces[texel.face]} (${texel.x}, ${texel.y}) of ${plane.width} × ${plane.width}: ${value.map(formatFloat).join('  ')}`;
  });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    change({ fov: Math.min(150, Math.max(5, state().fov * Math.exp(event.deltaY * 0.001))) });
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    const by = { ArrowLeft: [-15, 0], ArrowRight: [15, 0], ArrowUp: [0, 15], ArrowDown: [0, -15] }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    turn(...by);
  });
  const names = index.cubemaps.map((each) => h('option', { value: each.name, selected: each === cube }, each.name));
  redraw(box, h('h2', {}, 'Cubemaps'), h('div', { class: 'chart-controls' },
    h('label', { class: 'control' }, 'file ', h('select', { onchange: (event) => update({ cube: event.target.value }) }, names)),
    slider('mip level', state().mip, { min: 0, max: piece.levels.length - 1, step: 1 }, (mip) => change({ mip })),
    slider('brightness', state().glow, { min: -8, max: 8, step: 0.5 }, (glow) => change({ glow })),
    h('span', { class: 'dim' }, `${piece.size} texels a side, ${piece.levels.length} levels`),
    h('button', { type: 'button', class: 'small', onclick: () => update({ page: '' }) }, 'back to the case')), canvas, readout);
  await draw();
}
