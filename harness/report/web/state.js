// What the page shows, as one flat object that the URL's hash mirrors: every view is a link.

/** Every key with its value at the start. A key that has this value is not in the hash. */
export const kDefaults = {
  page: '', // charts, cubemaps, atlas, or a case
  at: '', figure: '', // of the atlas: the section or "case:NAME", and the picture that is open
  cube: '', yaw: 0, pitch: 0, fov: 90, mip: 0, glow: 0, // the cubemap and how it is looked at
  error: '', cost: '', // of the charts
  f: '', // text of the filter
  case: '',
  a: '', // backend
  vs: 'expected', // what it is held against: "expected" or a backend
  o: '', // output
  e: -1, // place of the expectation; -1: the one that says most
  x: -1, y: -1, // pixel; -1: the worst
  layout: 'side', // side, slider, onion, blink, difference
  split: 0.5, // of slider and onion
  mode: 'auto', ev: 0, off: 0, norm: 0, ch: -1, gamma: -1, // gamma -1: by type, 0: sRGB
  dx: 1, signed: 0, hatch: 1, worst: 1,
  grid: -1, // level of the pyramid whose cells are drawn
  z: 0, cx: 0.5, cy: 0.5, // zoom (0: fit), and the image's place in the middle of a pane
  step: -1, // of the trace
  follow: 0, // the pixel follows the mouse
  p: '', // inspector: parameters that were changed, "material.ior=1.7;..."
  b: '', // inspector: backends to render on, by commas; empty: the usual ones
  beside: '', // inspector: the second backend of a trace, or "none"; empty: the one that tells most
};

/** Hash to state. Unknown keys and numbers that are none are left out. */
export function parseHash(hash) {
  const found = { ...kDefaults };
  for (const [key, text] of new URLSearchParams(hash.replace(/^#/, ''))) {
    if (!(key in kDefaults)) continue;
    const isNumber = typeof kDefaults[key] === 'number';
    if (isNumber && !Number.isFinite(Number(text))) continue;
    found[key] = isNumber ? Number(text) : text;
  }
  return found;
}

export function formatHash(state) {
  const parts = new URLSearchParams();
  for (const [key, value] of Object.entries(kDefaults)) {
    if (state[key] !== value) parts.set(key, typeof value === 'number' ? String(Number(state[key].toPrecision(6))) : state[key]);
  }
  return '#' + parts.toString().replaceAll('%2F', '/').replaceAll('%2C', ',').replaceAll('%5B', '[').replaceAll('%5D', ']').replaceAll('%3D', '=').replaceAll('%3B', ';');
}

/** Holds the state; `onChange(state, keys)` hears each change once, with the keys that changed. */
export function createStore(onChange) {
  let state = parseHash(location.hash);
  let written = location.hash;
  let timer = 0;
  const writeHash = () => {
    timer = 0;
    written = formatHash(state);
    history.replaceState(null, '', written === '#' ? location.pathname + location.search : written);
  };
  addEventListener('hashchange', () => {
    if (location.hash === written) return;
    const next = parseHash(location.hash);
    const keys = Object.keys(kDefaults).filter((key) => next[key] !== state[key]);
    state = next;
    written = location.hash;
    onChange(state, new Set(keys));
  });
  return {
    get: () => state,
    update(patch) {
      const keys = Object.keys(patch).filter((key) => patch[key] !== state[key]);
      if (keys.length === 0) return;
      state = { ...state, ...patch };
      if (!timer) timer = setTimeout(writeHash, 120);
      onChange(state, new Set(keys));
    },
  };
}
