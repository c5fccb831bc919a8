// Numbers as the judge sees them: bits of a float, units in the last place, the error of a pixel by its output's type.
// No document here: node tests this file.

const view = new DataView(new ArrayBuffer(8));

/** The bits of a float as an unsigned number. */
export function floatBits(value) {
  view.setFloat32(0, value);
  return view.getUint32(0);
}

/** "0x3f800000" for 1. */
export function floatHex(value) {
  return '0x' + floatBits(value).toString(16).padStart(8, '0');
}

/** The shortest decimal that reads back as the same float. */
export function formatFloat(value) {
  if (Number.isNaN(value)) return 'NaN';
  if (!Number.isFinite(value)) return value > 0 ? '+Inf' : '-Inf';
  if (Object.is(value, -0)) return '-0';
  for (let digits = 1; digits <= 9; ++digits) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === Math.fround(value)) return tidyExponent(text);
  }
  return String(value);
}

function tidyExponent(text) {
  const plain = String(Number(text));
  return plain.length <= text.length + 4 ? plain : text;
}

/** A few digits, for statistics and scales. */
export function formatShort(value, digits = 4) {
  if (value === 'NaN' || value === 'Infinity' || value === '-Infinity') return value;
  if (value === null || value === undefined) return '';
  if (!Number.isFinite(value)) return formatFloat(value);
  const magnitude = Math.abs(value);
  if (value !== 0 && (magnitude < 1e-3 || magnitude >= 1e6)) {
    return value.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e');
  }
  return String(Number(value.toPrecision(digits)));
}

// The float's place on the line of all floats, so that -0 and 0 are the same place.
function orderedBits(value) {
  const bits = floatBits(value);
  return bits & 0x80000000 ? -(bits & 0x7fffffff) : bits;
}

/** Floats between two values; 0 for equal, infinite where one of them is NaN. */
export function ulpDistance(a, b) {
  if (a === b) return 0;
  if (Number.isNaN(a) || Number.isNaN(b)) return Infinity;
  return Math.abs(orderedBits(a) - orderedBits(b));
}

/** Degrees between two unit vectors, by sine and cosine: acos is blind for small angles. */
export function angleDegrees(e, a) {
  const d = [a[0] - e[0], a[1] - e[1], a[2] - e[2]];
  const cross = [d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]];
  const sine = Math.hypot(cross[0], cross[1], cross[2]);
  const cosine = a[0] * e[0] + a[1] * e[1] + a[2] * e[2];
  return (Math.atan2(sine, cosine) * 180) / Math.PI;
}

function isUnit(v) {
  const length = Math.hypot(v[0], v[1], v[2]);
  return Math.abs(length - 1) <= 1e-4;
}

function directionError(e, a) {
  if (isUnit(e) && isUnit(a)) return angleDegrees(e, a);
  const isZero = (v) => v.every((x) => x === 0);
  const isNaNVector = (v) => v.some(Number.isNaN);
  return (isZero(e) && isZero(a)) || (isNaNVector(e) && isNaNVector(a)) ? 0 : Infinity;
}

function numberError(e, a, isRelative) {
  if (e === a || (Number.isNaN(e) && Number.isNaN(a))) return 0;
  if (!Number.isFinite(e) || !Number.isFinite(a)) return Infinity;
  const difference = Math.abs(a - e);
  if (!isRelative) return difference;
  return e === 0 ? Infinity : difference / Math.abs(e);
}

/**
 * The error of one pixel in the unit of its type: degrees for directions, relative for depths, 0 or 1 for classes,
 * absolute for the rest. Infinite where no number tells how wrong it is.
 */
export function pixelError(type, expected, actual) {
  if (type === 'direction') return directionError(expected, actual);
  if (type === 'class') return expected[0] === actual[0] ? 0 : expected.concat(actual).some(Number.isNaN) ? Infinity : 1;
  let largest = 0;
  for (let i = 0; i < expected.length; ++i) {
    largest = Math.max(largest, numberError(expected[i], actual[i], type === 'depth'));
  }
  return largest;
}

/**
 * The bounds of a tolerance as run.json words it: "0.0001 relative or 4 ulp, below 1e-07 zero; 1 % may be off by up to
 * 0.5". Null where a float cannot tell: ulps of a double, budgets.
 */
export function parseTolerance(words) {
  const strict = words.split(';')[0];
  if (strict.startsWith('exact')) return { floor: 0 };
  if (/of a double|>=|<=/.test(strict)) return null;
  const bounds = { floor: Number(strict.match(/below (\S+) zero/)?.[1] ?? 0) };
  for (const [, number, unit] of strict.matchAll(/(\S+) (degrees|relative|absolute|ulp)\b/g)) bounds[unit] = Number(number);
  return Object.keys(bounds).length > 1 ? bounds : null;
}

function isNumberWithin(e, a, bounds) {
  if (e === a || (Number.isNaN(e) && Number.isNaN(a))) return true;
  if (!Number.isFinite(e) || !Number.isFinite(a)) return false;
  if (Math.abs(e) < bounds.floor && Math.abs(a) < bounds.floor) return true;
  const difference = Math.abs(a - e);
  return difference <= (bounds.absolute ?? -1) || difference <= (bounds.relative ?? -1) * Math.abs(e)
    || ulpDistance(e, a) <= (bounds.ulp ?? -1);
}

/** Whether a pixel is within the bounds, as the judge's rule is. */
export function isWithin(type, expected, actual, bounds) {
  if (type === 'direction') return pixelError(type, expected, actual) <= (bounds.degrees ?? 0);
  return expected.every((e, i) => isNumberWithin(e, actual[i], bounds));
}

/** What pixelError counts in. */
export function unitOf(type) {
  return { direction: 'degrees', depth: 'relative', class: 'class' }[type] ?? 'absolute';
}

const kClassNames = ['no raycast', 'hit', 'miss', 'unknown'];

/** The name of a HitSuccess value; "not a class" for all others. */
export function className(value) {
  return kClassNames[value] ?? 'not a class';
}

/** "NaN", "-Infinity" and numbers of run.json as numbers. */
export function numberOf(json) {
  return typeof json === 'string' ? Number(json) : json;
}
