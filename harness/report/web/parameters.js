// The parameters of a case that a person has changed: in the address, and as sliders have them. Pure.

/** "material.ior=1.7;camera.projection=orthographic" to {path: text}. */
export function parseParameters(text) {
  const found = {};
  for (const part of text.split(';')) {
    const at = part.indexOf('=');
    if (at > 0) found[part.slice(0, at)] = part.slice(at + 1);
  }
  return found;
}

export function formatParameters(values) {
  return Object.entries(values).map(([path, value]) => `${path}=${value}`).join(';');
}

/** The text of a parameter as its control's type; undefined where it is none. */
export function valueOf(control, text) {
  if (control.type === 'choice') return control.choices.includes(text) ? text : undefined;
  if (control.type === 'boolean') return text === 'true' ? true : text === 'false' ? false : undefined;
  const value = Number(text);
  return text.trim() === '' || !Number.isFinite(value) ? undefined : control.type === 'integer' ? Math.round(value) : value;
}

/** What a request carries: the changed parameters that the case has, by their types. */
export function parametersOf(controls, text) {
  const given = parseParameters(text);
  const found = {};
  for (const control of controls) {
    if (!(control.path in given)) continue;
    const value = valueOf(control, given[control.path]);
    if (value !== undefined) found[control.path] = value;
  }
  return found;
}

/** Within the control's bounds; a bound that is out itself is missed by little. */
export function clampValue(control, value) {
  const little = control.type === 'integer' ? 1 : 1e-3;
  const low = control.minimum === undefined ? -Infinity : control.minimum + (control.exclusiveMinimum ? little : 0);
  const high = control.maximum === undefined ? Infinity : control.maximum - (control.exclusiveMaximum ? little : 0);
  return Math.min(high, Math.max(low, value));
}

// 1, 2 or 5 times a power of ten.
function roundStep(rough) {
  const decade = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].find((each) => each * decade >= rough * 0.999) * decade;
}

/** The range of a control's slider: all that is allowed where that is little, else what lies around the case's own value. */
export function sliderRange(control) {
  const own = Number(control.value ?? control.default ?? 0);
  const reach = Math.max(2 * Math.abs(own), control.type === 'integer' ? 8 : 2);
  let low = control.minimum ?? -Infinity;
  let high = control.maximum ?? Infinity;
  if (high - low > 20 * reach) {
    low = Math.max(low, own - reach);
    high = Math.min(high, own + reach);
  }
  const step = control.type === 'integer' ? 1 : Number(roundStep((high - low) / 200).toPrecision(1));
  const first = control.type === 'integer' || !control.exclusiveMinimum ? low : low + step;
  return { min: control.type === 'integer' && control.exclusiveMinimum ? low + 1 : first, max: high, step };
}

/** Whether a control counts, going by the values that others have. */
export function counts(control, valueAt) {
  return !control.when || control.when.values.map(String).includes(String(valueAt(control.when.path)));
}
