// A contactd client in Node on @grpc/grpc-js. The contract is read from proto/ at run time.

import {fileURLToPath} from 'node:url';
import {setTimeout as pause} from 'node:timers/promises';

import grpc from '@grpc/grpc-js';
import loader from '@grpc/proto-loader';

const FINAL = ['SUCCEEDED', 'FAILED', 'CANCELLED'];
const GIVE_UP_AFTER_TRIES = 20;

/**
 * Loads the contract.
 * @param {string} protoDir the folder that holds contact/v1
 */
export function loadContract(protoDir = fileURLToPath(new URL('../../proto', import.meta.url))) {
  const definition = loader.loadSync('contact/v1/job_service.proto', {
    includeDirs: [protoDir], keepCase: true, enums: String, longs: Number, oneofs: true,
    defaults: true,
  });
  return grpc.loadPackageDefinition(definition).contact.v1;
}

/** A connection to one contactd. */
export class Client {
  /** @param {string} address HOST:PORT */
  constructor(address, contract = loadContract()) {
    this.stub = new contract.JobService(address, grpc.credentials.createInsecure(), {
      'grpc.max_receive_message_length': 256 << 20,
      'grpc.enable_http_proxy': 0,
    });
  }

  close() {
    this.stub.close();
  }

  /** Makes a unary call with a deadline; rejects with grpc.ServiceError. */
  call(method, request) {
    const deadline = Date.now() + 10_000;
    return new Promise((resolve, reject) => {
      this.stub[method](request, {deadline}, (error, answer) =>
        error ? reject(error) : resolve(answer));
    });
  }

  /** Submits a scenario, an object as its JSON or YAML would be; resolves to its job. */
  submit(scenario, requestId = crypto.randomUUID()) {
    return this.call('CreateJob', {job: {scenario}, request_id: requestId});
  }

  /**
   * The events of a job until it has ended. Watches again where it was when the link breaks: no
   * event is missed or repeated.
   */
  async * watch(name, kinds = []) {
    let sequence = 0;
    for (let tries = 0; ; ++tries) {
      const stream = this.stub.WatchJob({name, kinds, after_sequence: sequence});
      try {
        for await (const {events} of stream) {
          tries = 0;
          for (const event of events) {
            const stored = !['bookmark', 'gap', 'progress'].includes(event.payload);
            if (stored && event.sequence <= sequence) continue;
            sequence = Math.max(sequence, event.sequence);
            yield event;
            if (FINAL.includes(event.state_changed?.state)) return;
          }
        }
      } catch (error) {
        if (error.code !== grpc.status.UNAVAILABLE || tries >= GIVE_UP_AFTER_TRIES) throw error;
      } finally {
        stream.cancel();
      }
      await pause(Math.min(200 * 2 ** tries, 10_000));
    }
  }
}

/**
 * The values of a frame column. Views the bytes where their place in memory allows.
 * @returns {Float64Array}
 */
export function values(column) {
  const {buffer, byteOffset, byteLength} = column.values;
  if (byteOffset % 8 === 0) return new Float64Array(buffer, byteOffset, byteLength / 8);
  return new Float64Array(buffer.slice(byteOffset, byteOffset + byteLength));
}
