// Planes of floats: how they come out of a report's data, and what is true of all their values.
// Pure but for DecompressionStream, which node has as well.
import { isWithin, pixelError } from 'crossray/numbers.js';

/** Values lie channel after channel, rows from the top. */
export class Plane {
  constructor(name, width, height, channels, data) {
    Object.assign(this, { name, width, height, channels, data });
  }

  get pixels() {
    return this.width * this.height;
  }

  at(x, y, channel = 0) {
    return this.data[channel * this.pixels + y * this.width + x];
  }

  /** All channels of a pixel. */
  pixel(x, y) {
    return Array.from({ length: this.channels }, (_, channel) => this.at(x, y, channel));
  }
}

function bytesFromBase64(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The bytes that were deflated and then written in base64. */
export const unpackBytes = (base64) => inflate(bytesFromBase64(base64));

/** Undoes harness/report/plane_data.cpp: base64, deflate, and bytes sorted by their place in the float. */
export async function unpackFloats(base64) {
  const sorted = await unpackBytes(base64);
  const count = sorted.length / 4;
  const bits = new Uint32Array(count);
  for (let byte = 0; byte < 4; ++byte) {
    const start = byte * count;
    const shift = byte * 8;
    for (let i = 0; i < count; ++i) bits[i] |= sorted[start + i] << shift;
  }
  return new Float32Array(bits.buffer);
}

/** Reads what harness/report/plane_data.h says of formatPlaneBytes(): {width, height, planes: [{name, channels, floats}]}. */
export function planesFromBytes(buffer) {
  const headSize = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, headSize)));
  let at = 4 + headSize;
  const take = (count) => {
    const floats = new Float32Array(buffer, at, count);
    at += 4 * count;
    return floats;
  };
  return { ...head, planes: head.planes.map((entry) => ({ ...entry, floats: take(head.width * head.height * entry.channels) })) };
}

/** Smallest and largest finite value, and how many are none. `channel` -1: of all. A depth of 0 means "none". */
export function measure(plane, channel = -1, skipsZero = false) {
  const start = channel < 0 ? 0 : channel * plane.pixels;
  const end = channel < 0 ? plane.data.length : start + plane.pixels;
  const found = { min: Infinity, max: -Infinity, nan: 0, plusInfinity: 0, minusInfinity: 0 };
  for (let i = start; i < end; ++i) {
    const value = plane.data[i];
    if (Number.isFinite(value)) {
      if (skipsZero && value === 0) continue;
      if (value < found.min) found.min = value;
      if (value > found.max) found.max = value;
    } else if (Number.isNaN(value)) {
      ++found.nan;
    } else if (value > 0) {
      ++found.plusInfinity;
    } else {
      ++found.minusInfinity;
    }
  }
  if (found.min > found.max) found.min = found.max = 0;
  return found;
}

/**
 * Which pixels an expectation compares: from the plane "mask@0,2" of the expected planes and, where it says 2, from the
 * backend's own HitSuccess. Null: all of them.
 */
export function compareMask(expectedPlanes, index, hitSuccess) {
  const plane = expectedPlanes.find((each) => {
    const [word, places] = each.name.split('@');
    return word === 'mask' && places.split(',').map(Number).includes(index);
  });
  if (!plane) return null;
  const mask = new Uint8Array(plane.pixels);
  for (let i = 0; i < mask.length; ++i) {
    mask[i] = plane.data[i] === 2 ? (hitSuccess && hitSuccess.data[i] === 1 ? 1 : 0) : plane.data[i];
  }
  return mask;
}

/** 0 where the condition of a pixel's question is above the bound; null where that is nowhere, or was not measured. */
export function decidableMask(conditioningPlanes, output, bound) {
  const plane = conditioningPlanes?.find((each) => each.name === `${output}@condition`);
  if (!plane || !plane.data.some((condition) => condition > bound)) return null;
  return Uint8Array.from(plane.data, (condition) => (condition > bound ? 0 : 1));
}

/**
 * Errors by pixel, by the type's own measure, and which of them are beyond the bounds (all, where there are none to
 * tell); 0 outside the mask.
 */
export function compareDisplay(type, expected, actual, mask, bounds) {
  const errors = new Float64Array(expected.pixels);
  const beyond = new Uint8Array(expected.pixels);
  const e = new Array(expected.channels);
  const a = new Array(expected.channels);
  for (let pixel = 0; pixel < errors.length; ++pixel) {
    if (mask && !mask[pixel]) continue;
    for (let channel = 0; channel < expected.channels; ++channel) {
      e[channel] = expected.data[channel * expected.pixels + pixel];
      a[channel] = actual.data[channel * expected.pixels + pixel];
    }
    errors[pixel] = pixelError(type, e, a);
    beyond[pixel] = errors[pixel] > 0 && (!bounds || !isWithin(type, e, a, bounds)) ? 1 : 0;
  }
  return { errors, beyond };
}

/** How many are beyond, and how many more would be if they could be decided, which the judge does not count either. */
export function countBeyond(beyond, decidable) {
  const excused = decidable ? beyond.reduce((sum, each, i) => sum + (each && !decidable[i] ? 1 : 0), 0) : 0;
  return { excused, count: beyond.reduce((sum, each) => sum + each, 0) - excused };
}

/** Pixels with an error, the largest first; at most `limit`. */
export function rankErrors(errors, limit = 65536) {
  const wrong = [];
  for (let i = 0; i < errors.length; ++i) if (errors[i] > 0) wrong.push(i);
  wrong.sort((a, b) => (errors[b] === errors[a] ? a - b : errors[b] - errors[a]));
  return wrong.slice(0, limit);
}
