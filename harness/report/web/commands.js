// The commands that a page hands over, as a shell takes them.

/** Quotes where it must: names of sub-cases have brackets. */
export function quoteForShell(text) {
  if (/^[A-Za-z0-9/._:+,%@-]+$/.test(text)) return text;
  return `'${text.replaceAll("'", "'\\''")}'`;
}

/** A case as every verb takes it wherever it lies: its file, and which sub-case. A name is looked up in one case folder alone. */
export function caseArgument({ name, file }) {
  const bracket = name.indexOf('[');
  return file ? file + (bracket < 0 ? '' : name.slice(bracket)) : name;
}

/** Runs the case again and keeps all planes. */
export function runCommand(item, backends) {
  return `crossray run ${quoteForShell(caseArgument(item))} --backend ${quoteForShell(backends.join(','))} --planes all`;
}

/** Shows what the ray of a pixel does. */
export function traceCommand(item, x, y, backends, isJson = false) {
  const base = `crossray trace ${quoteForShell(caseArgument(item))} --pixel ${x},${y} --backend ${quoteForShell(backends.join(','))}`;
  return isJson ? `${base} --json` : base;
}

/** Records a golden from what this backend answered. */
export function acceptCommand(caseName, backend, runFolder) {
  return `crossray review --run ${quoteForShell(runFolder)} --accept ${quoteForShell(caseName)} --backend ${quoteForShell(backend)}`;
}

function quoteForToml(text) {
  return JSON.stringify(text);
}

/**
 * What goes into the case file to excuse a failure that no golden decides. `until`: "2026-01-31". The issue is the
 * person's to name.
 */
export function knownFailureToml(backends, reason, until) {
  const line = reason.split(/[\n;]/)[0];
  return [
    '[[known_failure]]',
    `backends = [${backends.map(quoteForToml).join(', ')}]`,
    'issue    = "LINK"',
    `until    = "${until}"`,
    `reason   = ${quoteForToml(line)}`,
  ].join('\n');
}
