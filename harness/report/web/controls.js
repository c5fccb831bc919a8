// The parameters of a case as controls: a number with a slider and a box, a switch, a choice. Built once a case and then
// kept, so that a slider that is being moved stays the same.
import { h } from 'crossray/dom.js';
import { clampValue, counts, sliderRange, valueOf } from 'crossray/parameters.js';

const kFirst = ['material', 'projection', 'camera']; // open, and before the others
const idOf = (path) => `control-${path.replaceAll('.', '-')}`;

function numberInputs(control, change) {
  const { min, max, step } = sliderRange(control);
  const take = (text, field) => {
    const value = valueOf(control, text);
    if (value === undefined) return field && (field.value = ''); // what is no number changes nothing
    change(clampValue(control, value));
  };
  const slider = h('input', { type: 'range', id: `${idOf(control.path)}-slider`, min, max, step, 'aria-label': `${control.group} ${control.label}, slider`,
    oninput: (event) => take(event.target.value) });
  const box = h('input', { type: 'number', id: idOf(control.path), step: 'any', min: control.minimum, max: control.maximum,
    onchange: (event) => take(event.target.value, event.target) });
  return {
    elements: [slider, box],
    show: (value) => {
      if (document.activeElement !== slider || Number(slider.value) !== value) slider.value = value ?? min;
      if (document.activeElement !== box || valueOf(control, box.value) !== value) box.value = value ?? '';
    },
  };
}

function makeInputs(control, change) {
  if (control.type === 'boolean') {
    const box = h('input', { type: 'checkbox', id: idOf(control.path), onchange: (event) => change(event.target.checked) });
    return { elements: [box], show: (value) => (box.checked = value === true) };
  }
  if (control.type === 'choice') {
    const box = h('select', { id: idOf(control.path), onchange: (event) => event.target.value !== '' && change(event.target.value) },
      (control.value ?? null) === null && h('option', { value: '' }, 'by the case'),
      control.choices.map((choice) => h('option', { value: choice }, choice)));
    return { elements: [box], show: (value) => (box.value = value ?? '') };
  }
  return numberInputs(control, change);
}

function makeRow(control, change) {
  const inputs = makeInputs(control, (value) => change(control.path, value));
  const reset = h('button', { type: 'button', class: 'small', 'aria-label': `Reset ${control.label}`, title: 'as the case has it', onclick: () => change(control.path, undefined) }, '↺');
  const element = h('div', { class: `parameter of-${control.type}`, title: control.summary ?? control.path },
    h('label', { for: idOf(control.path) }, control.label, control.unit && h('span', { class: 'dim' }, ` ${control.unit}`)), ...inputs.elements, reset);
  return { control, element, reset, show: inputs.show };
}

/** `change(path, value)`: undefined puts the case's own back. */
export function createControls(box, change) {
  let rows = [];
  let groups = [];

  /** Draws the controls of a case. */
  function build(controls) {
    const byGroup = new Map();
    rows = controls.map((control) => makeRow(control, change));
    for (const row of rows) byGroup.set(row.control.group, [...(byGroup.get(row.control.group) ?? []), row]);
    const rank = ([name]) => (kFirst.indexOf(name.split('.')[0]) + kFirst.length + 1) % (kFirst.length + 1);
    groups = [...byGroup].sort((a, b) => rank(a) - rank(b)).map(([name, members]) => {
      const count = h('span', { class: 'changed' });
      const element = h('details', { class: 'parameters', open: kFirst.some((first) => name === first || name.startsWith(`${first}.`)) }, h('summary', {}, name || 'case', count), members.map((row) => row.element));
      return { element, members, count };
    });
    box.replaceChildren(...(groups.length > 0 ? groups.map((group) => group.element) : [h('p', { class: 'dim' }, 'This case has no parameters.')]));
  }

  /** `values`: the changed ones by path. */
  function show(values) {
    const valueAt = (path) => values[path] ?? rows.find((row) => row.control.path === path)?.control.value;
    for (const { control, element, reset, show: showValue } of rows) {
      const isChanged = control.path in values;
      showValue(valueAt(control.path));
      element.classList.toggle('is-changed', isChanged);
      element.hidden = !counts(control, valueAt) && !isChanged;
      reset.hidden = !isChanged;
    }
    for (const { element, members, count } of groups) {
      const changed = members.filter((row) => row.control.path in values).length;
      count.textContent = changed > 0 ? ` ${changed} changed` : '';
      element.hidden = members.every((row) => row.element.hidden);
    }
  }
  return { build, show };
}
