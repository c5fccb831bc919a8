// The inspector's server as the page speaks to it. docs/inspector.md has the routes.

/** The server answered, with an error of its own. */
export class Refused extends Error {
  constructor(status, answer) {
    super(answer.error ?? `the server answered ${status}`);
    Object.assign(this, { status, answer });
  }
}

const kAskAgain = 700; // milliseconds, while there is no answer
const kLookAfter = 2000; // and while there is nothing to ask

/** `hooks`: {gone(reason), back()}: the first time that no answer comes, and when one comes again. */
export function createServer(token, hooks) {
  let isGone = false;

  async function ask(path, body) {
    const response = await fetch(path, {
      method: body === undefined ? 'GET' : 'POST', cache: 'no-store',
      headers: { 'X-Crossray-Token': token, ...(body === undefined ? {} : { 'Content-Type': 'application/json' }) },
      body: body === undefined ? undefined : JSON.stringify(body),
    });
    let answer;
    try {
      answer = response.headers.get('Content-Type') === 'application/octet-stream' ? await response.arrayBuffer() : await response.json();
    } catch (error) {
      if (response.ok) throw error; // cut off: as good as no answer
      answer = {};
    }
    if (!response.ok) throw new Refused(response.status, answer);
    return answer;
  }

  function lose(reason) {
    if (isGone) return;
    isGone = true;
    hooks.gone(reason);
    setTimeout(look, kAskAgain);
  }

  async function look() {
    try {
      await ask('/alive');
      isGone = false;
      hooks.back();
    } catch (error) {
      hooks.gone(error.status === 403 ? 'other' : 'silent');
      setTimeout(look, kAskAgain);
    }
  }

  /** The JSON of a route, or its bytes; rejects with Refused, or with another error where there was no answer. */
  async function request(path, body) {
    try {
      return await ask(path, body);
    } catch (error) {
      if (error.status === 403) lose('other');
      else if (!(error instanceof Refused)) lose('silent');
      throw error;
    }
  }
  setInterval(() => {
    if (!isGone && !document.hidden) request('/alive').catch(() => {});
  }, kLookAfter);
  return { request, isGone: () => isGone };
}
