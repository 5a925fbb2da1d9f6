// A contactd client for Node on @grpc/grpc-js, typed by what proto-loader-gen-types makes of proto/.

import {randomUUID} from 'node:crypto';
import {readFileSync, statSync} from 'node:fs';
import {setTimeout as pause} from 'node:timers/promises';
import {fileURLToPath} from 'node:url';

import grpc from '@grpc/grpc-js';
import loader from '@grpc/proto-loader';

import {Messages} from './checked.js';
import {ContactError, fromService, require} from './errors.js';
import type {AdminServiceClient} from './generated/contact/v1/AdminService.js';
import type {Event__Output as Event} from './generated/contact/v1/Event.js';
import type {GetSeriesRequest} from './generated/contact/v1/GetSeriesRequest.js';
import type {Job as JobInput, Job__Output as Job} from './generated/contact/v1/Job.js';
import type {JobServiceClient} from './generated/contact/v1/JobService.js';
import type {ListJobsRequest} from './generated/contact/v1/ListJobsRequest.js';
import type {ListJobsResponse__Output} from './generated/contact/v1/ListJobsResponse.js';
import type {ReadArtifactResponse__Output} from './generated/contact/v1/ReadArtifactResponse.js';
import type {Scenario} from './generated/contact/v1/Scenario.js';
import type {Series__Output as Series} from './generated/contact/v1/Series.js';
import type {ServerInfo__Output as ServerInfo} from './generated/contact/v1/ServerInfo.js';
import type {Sweep} from './generated/contact/v1/Sweep.js';
import type {WatchJobResponse__Output} from './generated/contact/v1/WatchJobResponse.js';
import type {WatchJobsRequest} from './generated/contact/v1/WatchJobsRequest.js';
import type {WatchJobsResponse__Output as JobChanges} from './generated/contact/v1/WatchJobsResponse.js';
import type {ProtoGrpcType as Admin} from './generated/admin_service.js';
import type {ProtoGrpcType as Jobs} from './generated/job_service.js';

export {ContactError, explain} from './errors.js';
export type {Violation} from './checked.js';
export type {Event, Job, JobChanges, Scenario, Series, ServerInfo, Sweep};
/** What an event can be about, such as `cycle`. */
export type Kind = NonNullable<Event['payload']>;

const FINAL: readonly string[] = ['SUCCEEDED', 'FAILED', 'CANCELLED'];
const NOT_STORED: readonly string[] = ['bookmark', 'gap', 'progress'];
const GIVE_UP_AFTER_TRIES = 20;
const DEADLINE_MS = 10_000; // Of a unary call.

const PROTO_DIR = fileURLToPath(new URL('../proto', import.meta.url));

type Contract = (Jobs & Admin)['contact']['v1'];

/** Loads the contract from the folder that holds contact/v1. */
export function loadContract(protoDir = PROTO_DIR): Contract {
  const files = ['contact/v1/job_service.proto', 'contact/v1/admin_service.proto'];
  const definition = loader.loadSync(files, {
    includeDirs: [protoDir], keepCase: true, enums: String, longs: Number, oneofs: true,
    defaults: true,
  });
  return (grpc.loadPackageDefinition(definition) as unknown as Jobs & Admin).contact.v1;
}

type Answer<T> = (error: grpc.ServiceError | null, answer?: T) => void;

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

/** What beside the spec goes with a new job: labels, priority, budget, time_to_live. */
export type JobOptions = Omit<JobInput, 'scenario' | 'sweep' | 'spec'> & {
  /** The same id and job make one job, however often submitted. */
  requestId?: string;
};

/** A connection to one contactd. Calls that fail throw a ContactError. */
export class Client {
  readonly stub: JobServiceClient;
  readonly admin: AdminServiceClient;
  private readonly messages: Messages;

  /** @param address HOST:PORT */
  constructor(address: string, files: CredentialFiles = {}, protoDir = PROTO_DIR) {
    const contract = loadContract(protoDir);
    const options = {'grpc.max_receive_message_length': 256 << 20, 'grpc.enable_http_proxy': 0};
    const credentials = credentialsOf(files);
    this.stub = new contract.JobService(address, credentials, options);
    this.admin = new contract.AdminService(address, credentials, options);
    this.messages = new Messages(protoDir);
  }

  close(): void {
    this.stub.close();
    this.admin.close();
  }

  /** Submits a scenario. Fields that the contract has not are told and not left out. */
  async submit(scenario: Scenario, options: JobOptions | string = {}): Promise<Job> {
    require(this.messages, 'contact.v1.Scenario', scenario, 'scenario');
    return this.create({scenario}, typeof options === 'string' ? {requestId: options} : options);
  }

  /** Submits a sweep; its cells are events. */
  async submitSweep(sweep: Sweep, options: JobOptions = {}): Promise<Job> {
    require(this.messages, 'contact.v1.Sweep', sweep, 'sweep');
    return this.create({sweep}, options);
  }

  /** What would become of a scenario: `warnings` and `estimate`; throws as submit does. */
  async validate(scenario: Scenario): Promise<Job> {
    require(this.messages, 'contact.v1.Scenario', scenario, 'scenario');
    return this.create({scenario}, {}, true);
  }

  /** The job as it is now, with its ledger so far. */
  get(name: string): Promise<Job> {
    return this.answered((options, answer) => this.stub.GetJob({name}, options, answer));
  }

  /** Jobs, newest first, page by page; without specs and ledgers. */
  async *list(filter: Omit<ListJobsRequest, 'page_token'> = {}): AsyncGenerator<Job, void> {
    for (let token = ''; ;) {
      const page = await this.answered<ListJobsResponse__Output>((options, answer) =>
        this.stub.ListJobs({...filter, page_token: token}, options, answer));
      yield* page.jobs;
      token = page.next_page_token;
      if (!token) return;
    }
  }

  /** Asks a job to stop; what it recorded is kept. */
  cancel(name: string): Promise<Job> {
    return this.answered((options, answer) => this.stub.CancelJob({name}, options, answer));
  }

  /** Gives a job, in whatever state, these labels in place of all that it has, and this note. */
  update(name: string, change: Pick<JobInput, 'labels' | 'note'>): Promise<Job> {
    const paths = (['labels', 'note'] as const).filter((field) => change[field] !== undefined);
    const request = {job: {...change, name}, update_mask: {paths}};
    return this.answered((options, answer) => this.stub.UpdateJob(request, options, answer));
  }

  /** Removes an ended job and its events. */
  async delete(name: string): Promise<void> {
    await this.answered((options, answer) => this.stub.DeleteJob({name}, options, answer));
  }

  /** Recorded motion, thinned to what a plot can show; see `values` for its columns. */
  series(name: string, request: Omit<GetSeriesRequest, 'name'> = {}): Promise<Series> {
    return this.answered((options, answer) =>
      this.stub.GetSeries({...request, name}, options, answer));
  }

  /** What the server is and accepts. */
  serverInfo(): Promise<ServerInfo> {
    return this.answered((options, answer) => this.stub.GetServerInfo({}, options, answer));
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
        const failure = this.told(error);
        if (failure.code !== grpc.status.UNAVAILABLE || tries >= GIVE_UP_AFTER_TRIES) throw failure;
      } finally {
        stream.cancel();
      }
      await pause(Math.min(200 * 2 ** tries, 10_000));
    }
  }

  /** What becomes of the jobs of a filter: those there are, then each change, without end. */
  async *watchJobs(filter: WatchJobsRequest = {}): AsyncGenerator<JobChanges, void> {
    yield* this.streamed<JobChanges>(this.stub.WatchJobs(filter));
  }

  /** An artifact of an ended job, such as `trajectory.csv`, in chunks. */
  async *artifact(name: string, artifact: string, offset = 0): AsyncGenerator<Buffer, void> {
    const parts = this.streamed<ReadArtifactResponse__Output>(
      this.stub.ReadArtifact({name, artifact, offset}));
    for await (const {data} of parts) if (data.length > 0) yield data;
  }

  /** A consistent copy of the server's store, in chunks. Needs the role `server`. */
  async *backup(): AsyncGenerator<Buffer, void> {
    for await (const {data} of this.streamed<{data: Buffer}>(this.admin.Backup({}))) yield data;
  }

  private create(spec: Pick<JobInput, 'scenario' | 'sweep'>, {requestId, ...job}: JobOptions,
                 validateOnly = false): Promise<Job> {
    const request = {job: {...job, ...spec}, request_id: requestId ?? randomUUID(),
                     validate_only: validateOnly};
    require(this.messages, 'contact.v1.CreateJobRequest', request, 'request');
    return this.answered((options, answer) => this.stub.CreateJob(request, options, answer));
  }

  /** Awaits a unary call. */
  private answered<T>(call: (options: grpc.CallOptions, answer: Answer<T>) => void): Promise<T> {
    return new Promise((resolve, reject) => {
      call({deadline: Date.now() + DEADLINE_MS}, (error, answer) => {
        if (error || answer === undefined) reject(this.told(error));
        else resolve(answer);
      });
    });
  }

  /** The messages of a stream. */
  private async *streamed<T>(stream: grpc.ClientReadableStream<any>): AsyncGenerator<T, void> {
    try {
      for await (const message of stream) yield message as T;
    } catch (error) {
      throw this.told(error);
    } finally {
      stream.cancel();
    }
  }

  private told(error: unknown): ContactError {
    return error instanceof ContactError ? error
      : fromService(error as grpc.ServiceError, this.messages);
  }
}

/** The values of a frame column. Views the bytes where their place in memory allows. */
export function values(column: {values: Buffer}): Float64Array {
  const {buffer, byteOffset, byteLength} = column.values;
  if (byteOffset % 8 === 0) return new Float64Array(buffer, byteOffset, byteLength / 8);
  return new Float64Array(buffer.slice(byteOffset, byteOffset + byteLength));
}
