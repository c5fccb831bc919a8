// Axes and elements that the charts share.

/** Of lines that may lie on one another. */
export const kDashes = [undefined, '7 3', '2 3', '9 3 2 3'];

/** Places of positive values between two ends in pixels, with ticks at 1, 2, 5. */
export function logAxis(values, from, to) {
  const positive = values.filter((value) => value > 0);
  let [low, high] = positive.length > 0 ? [Math.min(...positive), Math.max(...positive)] : [1, 10];
  [low, high] = [low / 1.4, high * 1.4];
  const place = (value) => from + (to - from) * Math.log(value / low) / Math.log(high / low);
  const ticks = [];
  for (let decade = Math.floor(Math.log10(low)); decade <= Math.log10(high); ++decade) {
    for (const step of high / low > 300 ? [1] : [1, 2, 5]) {
      const value = step * 10 ** decade;
      if (value >= low && value <= high) ticks.push(value);
    }
  }
  return { place, ticks };
}

/** An SVG element: svg('path', {d: ...}, child, ...). */
export function svg(tag, attributes, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) if (value !== undefined) element.setAttribute(name, value);
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** The same with even steps. */
export function linearAxis(values, from, to) {
  let [low, high] = [Math.min(...values), Math.max(...values)];
  if (!(high > low)) [low, high] = [low - 0.5, low + 0.5];
  const place = (value) => from + ((to - from) * (value - low)) / (high - low);
  const rough = (high - low) / 5;
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((each) => each * decade).find((each) => each >= rough);
  const ticks = [];
  for (let i = Math.ceil(low / step); i * step <= high + step * 1e-9; ++i) ticks.push(i * step);
  return { place, ticks };
}
