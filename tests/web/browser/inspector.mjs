// The inspector's server and page, as its tests use them.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { after } from 'node:test';
import { environment, openPage, program, until } from './fixture.mjs';

const kToken = 'a_token_of_the_tests_1234567890';
const servers = [];
after(() => servers.forEach((server) => server.kill('SIGKILL')));

/** Starts `crossray inspect` in a folder and reads the address that it prints: {server, url, port}. */
export function startInspector(folder, port = 0) {
  const server = spawn(program, ['inspect', '--port', String(port)], { cwd: folder, env: { ...environment(folder), CROSSRAY_INSPECT_TOKEN: kToken } });
  servers.push(server);
  return new Promise((done, fail) => {
    let said = '';
    const hear = (chunk) => {
      said += chunk;
      const address = said.match(/http:\/\/127\.0\.0\.1:(\d+)\/\?token=\S+/);
      if (address) done({ server, url: address[0], port: Number(address[1]) });
    };
    server.stdout.on('data', hear);
    server.stderr.on('data', hear);
    server.on('exit', () => fail(new Error(`the server ended: ${said}`)));
  });
}

export const textOf = (page, query) => page.locator(query).textContent();

const rendersOf = async (page) => Number(await page.locator('.live-status').first().getAttribute('data-renders') ?? 0);

/** Does something and waits for the rendering that follows. */
export async function nextRender(page, act) {
  const before = await rendersOf(page);
  await act();
  await until(() => rendersOf(page), (now) => now > before, 'a new rendering');
}

/** Moves a parameter's slider. */
export const slide = (page, path, value) => page.locator(`#control-${path.replaceAll('.', '-')}-slider`).fill(String(value));

/** The page of an address, once it has rendered. */
export async function opened(url, options) {
  const view = await openPage(url, options);
  assert.equal(await view.page.title(), 'crossray: inspector');
  await until(() => rendersOf(view.page), (count) => count > 0, 'the first rendering');
  return view;
}
