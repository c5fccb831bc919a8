// Colours for values. Source of the space: Bjoern Ottosson, "A perceptual color space for image processing" (OKLab, 2020).

/** OKLab lightness 0 to 1, chroma and hue in degrees to linear RGB; components may leave [0,1]. */
function linearFromOklch(lightness, chroma, hue) {
  const a = chroma * Math.cos((hue * Math.PI) / 180);
  const b = chroma * Math.sin((hue * Math.PI) / 180);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
}

/** Linear light to the display's encoding, both 0 to 1. */
export function encodeSrgb(linear) {
  const value = Math.min(1, Math.max(0, linear));
  return value <= 0.0031308 ? value * 12.92 : 1.055 * value ** (1 / 2.4) - 0.055;
}

// The strongest chroma up to `chroma` that a display has at this lightness and hue.
function displayColor(lightness, chroma, hue) {
  let low = 0;
  let high = chroma;
  const fits = (rgb) => rgb.every((x) => x >= -1e-4 && x <= 1.0001);
  if (!fits(linearFromOklch(lightness, high, hue))) {
    for (let i = 0; i < 12; ++i) {
      const middle = (low + high) / 2;
      if (fits(linearFromOklch(lightness, middle, hue))) low = middle;
      else high = middle;
    }
  } else {
    low = high;
  }
  return linearFromOklch(lightness, low, hue).map((x) => Math.round(encodeSrgb(x) * 255));
}

function makeTable(colorAt) {
  const table = new Uint8Array(256 * 3);
  for (let i = 0; i < 256; ++i) table.set(colorAt(i / 255), i * 3);
  return table;
}

/** One way: even steps of lightness from dark violet over green to bright yellow. */
export const sequentialTable = makeTable((t) => displayColor(0.2 + 0.74 * t, 0.16, 305 - 200 * t));

/** Two ways around grey: blue below, orange above, as dark as the other at the same distance. */
export const divergingTable = makeTable((t) => {
  const distance = Math.abs(2 * t - 1);
  return displayColor(0.93 - 0.45 * distance, 0.17 * distance ** 0.7, t < 0.5 ? 255 : 50);
});

/** HitSuccess: no raycast, hit, miss, unknown. Told apart by lightness, too. */
export const classColors = [[28, 30, 34], [118, 224, 128], [84, 110, 240], [232, 160, 60]];

/** Small whole numbers; 0 is nearly black. */
export const indexColors = [
  [24, 26, 30], [230, 97, 60], [86, 180, 233], [240, 228, 66], [0, 158, 115], [204, 121, 167], [240, 240, 240],
  [160, 110, 60], [120, 140, 250], [150, 220, 90], [250, 170, 170], [110, 110, 120],
];

export const nanColor = [255, 0, 255];
export const plusInfinityColor = [255, 255, 0];
export const minusInfinityColor = [0, 255, 255];

/** Writes the table's colour at t in [0,1]. */
export function lookUp(table, t, target, offset) {
  const i = Math.min(255, Math.max(0, Math.round(t * 255))) * 3;
  target[offset] = table[i];
  target[offset + 1] = table[i + 1];
  target[offset + 2] = table[i + 2];
}
