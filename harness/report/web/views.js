// Floats to pixels of a canvas. No document here: what is drawn depends on the plane and the settings alone.
import {
  classColors, divergingTable, encodeSrgb, indexColors, lookUp, minusInfinityColor, nanColor, plusInfinityColor,
  sequentialTable,
} from 'crossray/colors.js';

/** How a plane is shown; each is a choice in the page. */
export const kModes = {
  auto: 'by type',
  color: 'colour',
  map: 'perceptual map',
  signed: 'signed map',
  class: 'classes',
  hdrp: 'HDRP encoding',
};

const kNothing = [16, 17, 20];
const kNotCompared = [70, 74, 82];
const kWithin = [44, 52, 74];

const kSrgb = new Uint8Array(4096);
for (let i = 0; i < kSrgb.length; ++i) kSrgb[i] = Math.round(encodeSrgb(i / (kSrgb.length - 1)) * 255);

function toByte(value, gamma) {
  const v = value < 0 ? 0 : value > 1 ? 1 : value;
  if (gamma === 0) return kSrgb[Math.round(v * (kSrgb.length - 1))];
  return Math.round((gamma === 1 ? v : v ** (1 / gamma)) * 255);
}

/** What "by type" means for an output: mode, gamma (0: sRGB) and whether its range is taken from the values. */
export function defaultsOf(type) {
  switch (type) {
    case 'color': return { mode: 'color', gamma: 0, normalise: false };
    case 'direction': return { mode: 'hdrp', gamma: 1, normalise: false };
    case 'class': return { mode: 'class', gamma: 1, normalise: false };
    default: return { mode: 'map', gamma: 1, normalise: true };
  }
}

/** Settings with "by type" resolved. `range`: {min, max} that normalising maps to 0 and 1. */
export function resolveView(settings, type) {
  const base = defaultsOf(type);
  const isAuto = settings.mode === 'auto';
  return {
    ...settings,
    mode: isAuto ? base.mode : settings.mode,
    gamma: settings.gamma < 0 ? base.gamma : settings.gamma,
    normalise: settings.normalise || (isAuto && base.normalise),
  };
}

function indexColor(value) {
  if (value <= 0) return indexColors[0];
  return indexColors[1 + ((Math.trunc(value) - 1) % (indexColors.length - 1))];
}

// The encodings of HDRP's debug modes, as the shader library has them (crossray/debug/debug_modes.glsl).
function writeHdrp(type, values, out, offset) {
  const fract = (x) => x - Math.floor(x);
  let rgb;
  if (type === 'direction') rgb = values.map((v) => v * 0.5 + 0.5);
  else if (type === 'depth') rgb = Array(3).fill(fract(values[0] * 0.1));
  else if (type === 'class') rgb = [[0, 0, 0], [0.5, 1, 0.5], [0.5, 0.5, 1], [0.5, 0.5, 1]][values[0]] ?? [0, 0, 0];
  else if (type === 'count') {
    const bits = values[0] <= 0 ? 0 : ((values[0] - 1) % 7) + 1;
    rgb = [bits & 1, (bits >> 1) & 1, (bits >> 2) & 1];
  } else rgb = values.length === 1 ? Array(3).fill(values[0]) : [values[0], values[1], values[2] ?? 0];
  const gamma = type === 'color' ? 0 : 1;
  for (let i = 0; i < 3; ++i) out[offset + i] = toByte(rgb[i], gamma);
}

function loudColor(values) {
  let loud = null;
  for (const value of values) {
    if (Number.isNaN(value)) return nanColor;
    if (value === Infinity) loud = plusInfinityColor;
    if (value === -Infinity) loud = loud ?? minusInfinityColor;
  }
  return loud;
}

/**
 * The picture of a plane as bytes, four a pixel. `view`: {mode, channel (-1: all), exposure (stops), offset, gamma,
 * normalise, range}.
 */
export function drawPlane(plane, type, view) {
  const out = new Uint8ClampedArray(plane.pixels * 4);
  const gain = 2 ** view.exposure;
  const range = view.normalise && view.range ? view.range : { min: 0, max: 1 };
  const scale = range.max > range.min ? 1 / (range.max - range.min) : 1;
  const apply = (value) => ((value - range.min) * scale + view.offset) * gain;
  const magnitude = Math.max(Math.abs(range.min), Math.abs(range.max)) || 1;
  const shown = view.channel >= 0 ? [Math.min(view.channel, plane.channels - 1)] : [...Array(plane.channels).keys()];
  const values = new Array(shown.length);
  for (let pixel = 0; pixel < plane.pixels; ++pixel) {
    const offset = pixel * 4;
    for (let i = 0; i < shown.length; ++i) values[i] = plane.data[shown[i] * plane.pixels + pixel];
    out[offset + 3] = 255;
    const loud = loudColor(values);
    if (loud) out.set(loud, offset);
    else if (type === 'depth' && view.mode === 'map' && values[0] === 0) out.set(kNothing, offset);
    else if (view.mode === 'hdrp' && view.channel < 0) writeHdrp(type, values, out, offset);
    else if (view.mode === 'class') {
      out.set(type === 'class' ? classColors[values[0]] ?? nanColor : indexColor(values[0]), offset);
    } else if (view.mode === 'map') {
      const value = values.length === 1 ? values[0] : Math.hypot(...values);
      lookUp(sequentialTable, apply(value), out, offset);
    } else if (view.mode === 'signed') {
      const value = (values[0] / (view.normalise ? magnitude : 1) + view.offset) * gain;
      lookUp(divergingTable, 0.5 + 0.5 * value, out, offset);
    } else {
      for (let i = 0; i < 3; ++i) out[offset + i] = toByte(apply(values[Math.min(i, values.length - 1)]), view.gamma);
    }
  }
  return out;
}

/**
 * The picture of a difference. `errors`: by pixel, in the type's unit; `largest` is at the map's end. What is within the
 * tolerance is dark. Signed: actual minus expected of one channel around white.
 */
export function drawDifference(expected, actual, { errors, beyond }, mask, { multiplier, signed, channel, largest }) {
  const out = new Uint8ClampedArray(expected.pixels * 4);
  const scale = multiplier / (largest > 0 ? largest : 1);
  const first = Math.max(0, Math.min(channel, expected.channels - 1)) * expected.pixels;
  let largestSigned = 0;
  for (let i = 0; signed && i < expected.pixels; ++i) {
    const difference = Math.abs(actual.data[first + i] - expected.data[first + i]);
    if (Number.isFinite(difference) && (!mask || mask[i])) largestSigned = Math.max(largestSigned, difference);
  }
  for (let pixel = 0; pixel < expected.pixels; ++pixel) {
    const offset = pixel * 4;
    out[offset + 3] = 255;
    if (mask && !mask[pixel]) {
      out.set(kNotCompared, offset);
    } else if (errors[pixel] === Infinity) {
      out.set(nanColor, offset);
    } else if (signed) {
      const difference = actual.data[first + pixel] - expected.data[first + pixel];
      lookUp(divergingTable, 0.5 + (0.5 * difference * multiplier) / (largestSigned || 1), out, offset);
    } else if (errors[pixel] > 0) {
      // What is beyond stands out from what is not, however little it is.
      const t = Math.min(1, errors[pixel] * scale);
      if (beyond[pixel]) lookUp(sequentialTable, 0.42 + 0.58 * t, out, offset);
      else out.set(kWithin, offset);
    } else {
      out.set(kNothing, offset);
    }
  }
  return out;
}

/** The stops of a scale that is drawn beside the panes. */
export function scaleTable(mode) {
  return mode === 'signed' ? divergingTable : sequentialTable;
}
