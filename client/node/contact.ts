// A contactd client for Node on @grpc/grpc-js, typed by what proto-loader-gen-types makes of proto/.

import {randomUUID} from 'node:crypto';
import {readFileSync, statSync} from 'node:fs';
import {setTimeout as pause} from 'node:timers/promises';
import {fileURLToPath} from 'node:url';

import grpc from '@grpc/grpc-js';
import loader from '@grpc/proto-loader';

import type {Event__Output as Event} from './generated/contact/v1/Event.js';
import type {Job__Output as Job} from './generated/contact/v1/Job.js';
import type {JobServiceClient} from './generated/contact/v1/JobService.js';
import type {Scenario} from './generated/contact/v1/Scenario.js';
import type {WatchJobResponse__Output} from './generated/contact/v1/WatchJobResponse.js';
import type {ProtoGrpcType} from './generated/job_service.js';

export type {Event, Job, Scenario};
/** What an event can be about, such as `cycle`. */
export type Kind = NonNullable<Event['payload']>;

const FINAL: readonly string[] = ['SUCCEEDED', 'FAILED', 'CANCELLED'];
const NOT_STORED: readonly string[] = ['bookmark', 'gap', 'progress'];
const GIVE_UP_AFTER_TRIES = 20;
const DEADLINE_MS = 10_000; // Of a unary call.

/** Loads the contract from the folder that holds contact/v1. */
export function loadContract(
  protoDir = fileURLToPath(new URL('../proto', import.meta.url)),
): ProtoGrpcType['contact']['v1'] {
  const definition = loader.loadSync('contact/v1/job_service.proto', {
    includeDirs: [protoDir], keepCase: true, enums: String, longs: Number, oneofs: true,
    defaults: true,
  });
  return (grpc.loadPackageDefinition(definition) as unknown as ProtoGrpcType).contact.v1;
}

type Answer<T> = (error: grpc.ServiceError | null, answer?: T) => void;

/** Awaits a unary call; rejects with grpc.ServiceError. */
function answered<T>(call: (options: grpc.CallOptions, answer: Answer<T>) => void): Promise<T> {
  return new Promise((resolve, reject) => {
    call({deadline: Date.now() + DEADLINE_MS}, (error, answer) => {
      if (error || answer === undefined) reject(error);
      else resolve(answer);
    });
  });
}

/** Files by which client and server know each other. */
export interface CredentialFiles {
  /** Authorities of the server's certificate; without it there is no TLS. */
  tlsCa?: string;
  /** Certificate and private key that show the server who calls. */
  cert?: string;
  key?: string;
  /** File with a token that shows it. Only with tlsCa. */
  tokenFile?: string;
}

function secret(path: string): Buffer {
  if (statSync(path).mode & 0o027) throw new Error(`${path} can be read or changed by others`);
  return readFileSync(path);
}

function credentialsOf(files: CredentialFiles): grpc.ChannelCredentials {
  if (!files.tlsCa) {
    if (files.tokenFile || files.cert) throw new Error('tokens and certificates need tlsCa');
    return grpc.credentials.createInsecure();
  }
  const channel = grpc.credentials.createSsl(
    readFileSync(files.tlsCa), files.key ? secret(files.key) : null,
    files.cert ? readFileSync(files.cert) : null);
  if (!files.tokenFile) return channel;
  const token = secret(files.tokenFile).toString().trim();
  return grpc.credentials.combineChannelCredentials(
    channel, grpc.credentials.createFromMetadataGenerator((_, done) => {
      const metadata = new grpc.Metadata();
      metadata.set('authorization', `Bearer ${token}`);
      done(null, metadata);
    }));
}

/** A connection to one contactd. */
export class Client {
  readonly stub: JobServiceClient;

  /** @param address HOST:PORT */
  constructor(address: string, files: CredentialFiles = {}, contract = loadContract()) {
    this.stub = new contract.JobService(address, credentialsOf(files), {
      'grpc.max_receive_message_length': 256 << 20,
      'grpc.enable_http_proxy': 0,
    });
  }

  close(): void {
    this.stub.close();
  }

  /** Submits a scenario; the same id and scenario make one job, however often submitted. */
  submit(scenario: Scenario, requestId: string = randomUUID()): Promise<Job> {
    return answered((options, answer) =>
      this.stub.CreateJob({job: {scenario}, request_id: requestId}, options, answer));
  }

  /** The job as it is now, with its ledger so far. */
  get(name: string): Promise<Job> {
    return answered((options, answer) => this.stub.GetJob({name}, options, answer));
  }

  /**
   * The events of a job until it has ended. Watches again where it was when the link breaks: no
   * event is missed or repeated.
   */
  async *watch(name: string, kinds: Kind[] = []): AsyncGenerator<Event, void> {
    let sequence = 0;
    for (let tries = 0; ; ++tries) {
      const stream = this.stub.WatchJob({name, kinds, after_sequence: sequence});
      try {
        for await (const message of stream) {
          tries = 0;
          for (const event of (message as WatchJobResponse__Output).events) {
            const stored = event.payload === undefined || !NOT_STORED.includes(event.payload);
            if (stored && event.sequence <= sequence) continue;
            sequence = Math.max(sequence, event.sequence);
            yield event;
            if (event.state_changed && FINAL.includes(event.state_changed.state)) return;
          }
        }
      } catch (error) {
        const {code} = error as grpc.ServiceError;
        if (code !== grpc.status.UNAVAILABLE || tries >= GIVE_UP_AFTER_TRIES) throw error;
      } finally {
        stream.cancel();
      }
      await pause(Math.min(200 * 2 ** tries, 10_000));
    }
  }
}

/** What went wrong with a call, in one line with what to do about it. */
export function explain(error: unknown, address: string): string {
  const {code, details} = error as Partial<grpc.ServiceError>;
  if (code === grpc.status.UNAVAILABLE) {
    return `cannot reach contactd at ${address}; start one with contactctl dev, `
      + 'or give its HOST:PORT';
  }
  return code === undefined ? String(error) : `${grpc.status[code]}: ${details ?? ''}`;
}

/** The values of a frame column. Views the bytes where their place in memory allows. */
export function values(column: {values: Buffer}): Float64Array {
  const {buffer, byteOffset, byteLength} = column.values;
  if (byteOffset % 8 === 0) return new Float64Array(buffer, byteOffset, byteLength / 8);
  return new Float64Array(buffer.slice(byteOffset, byteOffset + byteLength));
}
