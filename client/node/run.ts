// node dist/run.js [HOST:PORT]: solves the paper's triple-ball chain and shows what came of it.

import {Client, explain, values, type Scenario} from './contact.js';

const body = (name: string, position_m: number, velocity_m_per_s = 0) =>
  ({name, mass_kg: 0.5, radius_m: 0.05, position_m, velocity_m_per_s});

const scenario: Scenario = {
  title: 'Triple-ball chain',
  bodies: [body('B1', 0.0, 0.2), body('B2', 0.1), body('B3', 0.2)],
  contacts: [
    {between: ['B1', 'B2'], stiffness: 1e8, restitution: 0.8},
    {between: ['B2', 'B3'], stiffness: 1e8, restitution: 0.7},
  ],
  end_time_s: 4e-3,
};

const address = process.argv[2] ?? process.env.CONTACT_SERVER ?? '127.0.0.1:7070';
const client = new Client(address, {
  tlsCa: process.env.CONTACT_TLS_CA, cert: process.env.CONTACT_CERT, key: process.env.CONTACT_KEY,
  tokenFile: process.env.CONTACT_TOKEN_FILE,
});

async function solve(): Promise<void> {
  const {name} = await client.submit(scenario);
  let samples = 0;
  let peak = 0;
  for await (const event of client.watch(name)) {
    if (event.cycle) {
      const {contact, kind, mu, restitution_out} = event.cycle;
      console.log(
        `${contact}  ${kind}  mu ${mu.toPrecision(10)}  restitution ${restitution_out.toFixed(9)}`);
    } else if (event.frame_chunk) {
      if (!event.frame_chunk.columns_follow) samples += event.frame_chunk.samples;
      const force = event.frame_chunk.columns.find(({name}) => name === 'B1-B2.contact_force');
      if (force) peak = values(force).reduce((a, b) => Math.max(a, b), peak);
    }
  }
  const job = await client.get(name);
  for (const {name: ball, velocity_m_per_s} of job.final_bodies) {
    console.log(`${ball}  ${velocity_m_per_s.toFixed(12)} m/s`);
  }
  console.log(`${samples} samples, largest force B1-B2 ${peak.toFixed(3)} N`);
  console.log(`${job.name}  ${job.state}  convergence ${job.convergence}`);
}

try {
  await solve();
} catch (error) {
  console.error(explain(error, address));
  process.exitCode = 1;
} finally {
  client.close();
}
