// The language of the filter box. Words are joined by "and":
//   s:failed   a verdict, or passed, failed, skipped       b:osmesa   a backend       o:HitDepth   an output
//   @probe     a tag       "two words" or word             part of the name or summary
//   !WORD      not that
// s: and b: speak of the same result: `s:failed b:osmesa` is "failed on osmesa". Case does not matter.

const kTallies = { passed: 'passed', failed: 'failed', skipped: 'skipped' };

/** Splits the text: [{kind: 'verdict'|'backend'|'output'|'tag'|'text', value, negated}]. */
export function parseFilter(text) {
  const terms = [];
  const words = text.match(/!?(?:[a-z]:|@)?"[^"]*"?|\S+/gi) ?? [];
  for (let word of words) {
    const negated = word.startsWith('!');
    if (negated) word = word.slice(1);
    const [, prefix, rest] = word.match(/^(s:|b:|o:|@)?(.*)$/is);
    const value = rest.replace(/^"|"$/g, '').toLowerCase();
    if (value === '') continue; // still being typed
    const kind = { 's:': 'verdict', 'b:': 'backend', 'o:': 'output', '@': 'tag' }[prefix?.toLowerCase()] ?? 'text';
    terms.push({ kind, value, negated });
  }
  return terms;
}

function hasVerdict(result, value) {
  return value in kTallies ? result.tally === value : result.verdict.startsWith(value);
}

function matchesResult(term, result) {
  const fits = term.kind === 'verdict' ? hasVerdict(result, term.value) : result.backend.toLowerCase().includes(term.value);
  return fits !== term.negated;
}

function matchesCase(term, item) {
  const text = (haystack) => haystack.toLowerCase().includes(term.value);
  const fits = term.kind === 'output' ? item.outputs.some((name) => name.toLowerCase().startsWith(term.value))
    : term.kind === 'tag' ? item.tags.some((tag) => tag.toLowerCase().startsWith(term.value))
      : text(item.name) || text(item.summary);
  return fits !== term.negated;
}

/**
 * The results of a case that the terms leave, or null when the case is out. `item`: {name, summary, tags, outputs,
 * results: [{backend, verdict, tally}]}. A case without results passes when nothing asks for them.
 */
export function filterCase(terms, item) {
  const ofResults = terms.filter((term) => term.kind === 'verdict' || term.kind === 'backend');
  const ofCase = terms.filter((term) => !ofResults.includes(term));
  if (!ofCase.every((term) => matchesCase(term, item))) return null;
  if (ofResults.length === 0) return item.results;
  const left = item.results.filter((result) => ofResults.every((term) => matchesResult(term, result)));
  return left.length > 0 ? left : null;
}
