// From what the state asks for to what there is: the backend, the output, the expectation and the planes that the page
// shows. Pure; the state's empty places become the choice that says most.

const kAgreement = 'agree with ';
export const kNoBackend = new Set(['expected', 'conditioning']); // sources of planes that no backend gave

/** The result that a person wants to see first: the first that failed. */
export function chooseBackend(item, wanted) {
  const named = item.results.find((result) => result.backend === wanted);
  return named ?? item.results.find((result) => result.tally === 'failed') ?? item.results[0] ?? null;
}

function isFailure(expectation, mustFail) {
  return expectation.missingGolden || (expectation.judged && expectation.comparison.passed === mustFail);
}

/** Outputs in the order of the tabs: those of the planes that are there, then those that are only expected. */
export function listOutputs(item, planesOf) {
  const names = new Set();
  for (const [source, planes] of planesOf) {
    if (!kNoBackend.has(source)) planes.forEach((plane) => names.add(plane.name));
  }
  item.outputs.forEach((name) => names.add(name));
  return [...names];
}

/** The expectation of an output on a backend: the one asked for, else the first that failed, else the first. */
export function chooseExpectation(details, backend, output, wanted) {
  const result = details?.backends.find((each) => each.backend === backend);
  const candidates = result?.expectations.filter((each) => each.output === output) ?? [];
  return candidates.find((each) => each.index === wanted)
    ?? candidates.find((each) => isFailure(each, details.mustFail)) ?? candidates[0] ?? null;
}

/** The plane that an expectation holds the backend against, and the words for it. Null when it was not kept. */
export function expectedPlane(planesOf, expectation, output) {
  if (!expectation) return null;
  if (expectation.source.startsWith(kAgreement)) {
    const backend = expectation.source.slice(kAgreement.length);
    const plane = planesOf.get(backend)?.find((each) => each.name === output);
    return plane ? { plane, title: `expected: as ${backend}` } : null;
  }
  const plane = planesOf.get('expected')?.find((each) => each.name === `${output}@${expectation.index}`);
  return plane ? { plane, title: `expected: ${expectation.source}` } : null;
}

/**
 * {result, output, type, expectation, expected, against, actual}: `against` is what the actual plane is held against,
 * the expectation or another backend; each of the three is {plane, title} or null.
 */
export function choose(state, item, details, planesOf, outputs) {
  const result = chooseBackend(item, state.a);
  const names = listOutputs(item, planesOf);
  const output = names.includes(state.o) ? state.o : names.includes(result?.output) ? result.output : names[0] ?? '';
  const backend = result?.backend ?? '';
  const wanted = state.e >= 0 ? state.e : output === result?.output ? result.expectation ?? -1 : -1;
  const expectation = chooseExpectation(details, backend, output, wanted);
  const planeOf = (source) => planesOf.get(source)?.find((plane) => plane.name === output);
  const expected = expectedPlane(planesOf, expectation, output);
  const other = state.vs !== 'expected' && state.vs !== backend ? planeOf(state.vs) : undefined;
  const actual = planeOf(backend);
  return {
    result, backend, output, names, expectation, expected,
    type: outputs.find((each) => each.name === output)?.type ?? 'scalar',
    unit: outputs.find((each) => each.name === output)?.unit ?? '',
    against: other ? { plane: other, title: state.vs } : expected,
    isAgainstBackend: other !== undefined,
    actual: actual ? { plane: actual, title: `actual: ${backend}` } : null,
  };
}
