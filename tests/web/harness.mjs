// A contactd with its dashboard, and a browser that looks at it.

import {spawn} from 'node:child_process';
import {createHash} from 'node:crypto';
import {existsSync, mkdtempSync, openSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {connect, createServer} from 'node:net';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {setTimeout as pause} from 'node:timers/promises';
import {fileURLToPath} from 'node:url';

import {chromium} from 'playwright-core';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
export const BINARY = process.env.CONTACTD ?? join(ROOT, 'build/release/server/contactd');
const WEB = `${ROOT}client/web/dist`;
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
    this.process = spawn(BINARY,
      ['--listen=127.0.0.1:0', `--data-dir=${this.folder}/data`, `--http-listen=127.0.0.1:${this.port}`,
        `--http-port-file=${file}`, `--web-dir=${WEB}`, ...this.flags], {stdio: 'ignore'});
    await until(() => existsSync(file) && readFileSync(file, 'utf8').trim(), 'the port of the gateway');
    this.port = Number(readFileSync(file, 'utf8'));
    return this;
  }

  /** Ends it. Fails if it was asked to end and did not do so as it should. */
  async end(signal = 'SIGTERM') {
    if (!this.process) return;
    const ended = new Promise((resolve) => { this.process.once('exit', (code, by) => resolve(code ?? by)); });
    this.process.kill(signal);
    const how = await ended;
    this.process = undefined;
    if (signal === 'SIGTERM' && how !== 0) throw new Error(`contactd ended with ${how}`);
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

/**
 * A contactd that asks for a token, on socket files as such a server wants it, and a port before it
 * that passes bytes on, as nginx would.
 */
export class AskingServer extends Server {
  token = 'ctk_aaaaaaaa_'.padEnd(56, 'a');

  /** What the server has written about itself and about its callers. */
  written() { return ['log', 'audit'].map((name) => readFileSync(join(this.folder, name), 'utf8')).join(''); }

  async start() {
    const path = (name) => join(this.folder, name);
    const digest = createHash('sha256').update(this.token).digest('hex');
    writeFileSync(path('tokens'), `aaaaaaaa ${digest} 2099-01-01T00:00:00Z valid user:ada tenant:acme roles:admin\n`, {mode: 0o600});
    this.process = spawn(BINARY, [`--listen=unix:${path('grpc')}`, `--http-listen=unix:${path('http')}`, `--tokens=${path('tokens')}`,
      `--data-dir=${path('data')}`, `--audit-log=${path('audit')}`, '--log-level=debug', `--web-dir=${WEB}`],
    {stdio: ['ignore', 'ignore', openSync(path('log'), 'w')]});
    await until(() => existsSync(path('http')), 'the socket of the gateway');
    this.proxy = createServer((outer) => {
      const inner = connect(path('http'));
      for (const [one, other] of [[outer, inner], [inner, outer]]) one.pipe(other).on('error', () => one.destroy());
    });
    await new Promise((resolve) => { this.proxy.listen(0, '127.0.0.1', resolve); });
    this.port = this.proxy.address().port;
    return this;
  }

  async end(signal) {
    this.proxy?.close();
    await super.end(signal);
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
