// A contactd with its dashboard, and a browser that looks at it.

import {spawn} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {setTimeout as pause} from 'node:timers/promises';
import {fileURLToPath} from 'node:url';

import {chromium} from 'playwright-core';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
export const PATIENCE_MS = 20_000;
const ARGUMENTS = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];

/** Waits until `ready` gives something true. */
export async function until(ready, what) {
  const end = Date.now() + PATIENCE_MS;
  for (;;) {
    const value = await ready();
    if (value) return value;
    if (Date.now() > end) throw new Error(`waited in vain for ${what}`);
    await pause(20);
  }
}

/** One contactd after the other on the same data and the same HTTP port. */
export class Server {
  folder = mkdtempSync(join(tmpdir(), 'contact-web-'));
  port = 0;
  process = undefined;
  constructor(...flags) { this.flags = flags; }

  get origin() { return `http://127.0.0.1:${this.port}`; }

  async start() {
    const file = join(this.folder, 'http-port');
    rmSync(file, {force: true});
    this.process = spawn(process.env.CONTACTD ?? join(ROOT, 'build/release/server/contactd'),
      ['--listen=127.0.0.1:0', `--data-dir=${this.folder}/data`, `--http-listen=127.0.0.1:${this.port}`,
        `--http-port-file=${file}`, `--web-dir=${ROOT}client/web/dist`, ...this.flags], {stdio: 'ignore'});
    await until(() => existsSync(file) && readFileSync(file, 'utf8').trim(), 'the port of the gateway');
    this.port = Number(readFileSync(file, 'utf8'));
    return this;
  }

  async end(signal = 'SIGTERM') {
    if (!this.process) return;
    const ended = new Promise((resolve) => { this.process.once('exit', resolve); });
    this.process.kill(signal);
    await ended;
    this.process = undefined;
  }

  async close() {
    await this.end();
    rmSync(this.folder, {recursive: true, force: true});
  }

  /** A unary call as curl would make it. */
  async call(method, message = {}) {
    const answer = await fetch(`${this.origin}/contact.v1.JobService/${method}`, {
      method: 'POST', headers: {'content-type': 'application/json'}, body: JSON.stringify(message)});
    const body = await answer.json();
    if (!answer.ok) throw new Error(`${method}: ${JSON.stringify(body)}`);
    return body;
  }

  /** Submits a scenario; returns the id of the job. */
  async submit(scenario, rest = {}) {
    return (await this.call('CreateJob', {job: {scenario, ...rest}})).name.replace('jobs/', '');
  }

  /** Waits for the end of a job. */
  async ended(id) {
    return until(async () => {
      const job = await this.call('GetJob', {name: `jobs/${id}`});
      return ['SUCCEEDED', 'FAILED', 'CANCELLED'].includes(job.state) && job;
    }, `the end of ${id}`);
  }
}

/** A browser without anything of another one. */
export function openBrowser() {
  return chromium.launch({executablePath: '/usr/bin/chromium', args: ARGUMENTS});
}

/** A page that notes what it must not do. */
export async function openPage(browser, server, options = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 900}, ...options});
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  page.faults = [];
  page.on('pageerror', (error) => page.faults.push(`error: ${error.message}`));
  page.on('console', (message) => {
    if (message.type() === 'error' && !/ERR_CONNECTION|ERR_INCOMPLETE|Failed to load resource/.test(message.text())) page.faults.push(message.text());
  });
  page.on('request', (request) => {
    const {protocol, origin} = new URL(request.url());
    if (protocol !== 'blob:' && protocol !== 'data:' && origin !== server.origin) page.faults.push(`left the origin: ${request.url()}`);
  });
  return page;
}

export const CHAIN = {
  title: 'Triple-ball chain',
  bodies: [0, 1, 2].map((i) => ({name: `B${i + 1}`, massKg: 0.5, radiusM: 0.05, positionM: 0.1 * i, velocityMPerS: i === 0 ? 0.2 : 0})),
  contacts: [
    {name: 'B1-B2', between: ['B1', 'B2'], stiffness: 1e8, restitution: 0.8},
    {name: 'B2-B3', between: ['B2', 'B3'], stiffness: 1e8, restitution: 0.7}],
  endTimeS: 0.004,
};

/** A ball that bounces on a spring for `seconds` of the model; a second takes a while. */
export const swinging = (seconds, solver = {}) => ({
  title: 'Spring-supported ball at a wall',
  bodies: [{name: 'ball', massKg: 0.5, radiusM: 0.05, positionM: -0.01}],
  contacts: [{name: 'ball-wall', between: ['ball'], wall: {positionM: 0.048, side: 'RIGHT'}, stiffness: 1.8e7, restitution: 0.9}],
  supports: [{body: 'ball', stiffnessNPerM: 1e6, dampingNSPerM: 100}],
  loads: [{body: 'ball', constant: {forceN: 500}}, {body: 'ball', sine: {amplitudeN: 250, angularFrequencyRadPerS: 2000}}],
  endTimeS: seconds, solver,
});
