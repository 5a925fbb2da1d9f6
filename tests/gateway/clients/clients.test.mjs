// The gateway as clients of other projects see it. SERVER: http://HOST:PORT; JOB: an ended job; DESCRIPTORS: the contract as protoc's descriptor set.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import test from "node:test";
import { promisify } from "node:util";

import { create, createFileRegistry, fromBinary, toBinary } from "@bufbuild/protobuf";
import { FileDescriptorSetSchema } from "@bufbuild/protobuf/wkt";
import { Code, ConnectError, createClient } from "@connectrpc/connect";
import * as node from "@connectrpc/connect-node";
import * as web from "@connectrpc/connect-web";
import grpcWeb from "grpc-web";
import xhr2 from "xhr2";

const { SERVER, JOB, DESCRIPTORS } = process.env;
const registry = createFileRegistry(
  fromBinary(FileDescriptorSetSchema, readFileSync(DESCRIPTORS)));
const service = registry.getService("contact.v1.JobService");
const input = (name) => registry.getMessage(`contact.v1.${name}`);

const transports = {};
for (const [where, library] of [["node", node], ["web", web]]) {
  for (const binary of [false, true]) {
    for (const get of [false, true]) {
      const options = { baseUrl: SERVER, httpVersion: "1.1", useBinaryFormat: binary,
                        useHttpGet: get };
      const kind = `${where} ${binary ? "binary" : "JSON"}${get ? " GET" : ""}`;
      transports[`connect ${kind}`] = library.createConnectTransport(options);
      if (!get) transports[`grpc-web ${kind}`] = library.createGrpcWebTransport(options);
    }
  }
}

transports["connect node HTTP/2"] = node.createConnectTransport({ baseUrl: SERVER, httpVersion: "2" });
transports["grpc-web node HTTP/2"] = node.createGrpcWebTransport({ baseUrl: SERVER, httpVersion: "2" });
transports["grpc node HTTP/2"] = node.createGrpcTransport({ baseUrl: SERVER, httpVersion: "2" });

async function fails(code, promise) {
  const error = ConnectError.from(await promise.then(() => assert.fail("it worked"), (e) => e));
  assert.equal(error.code, code, error.message);
  return error;
}

async function all(stream) {
  const messages = [];
  for await (const message of stream) messages.push(message);
  return messages;
}

for (const [kind, transport] of Object.entries(transports)) {
  const client = createClient(service, transport);

  test(`${kind}: a unary call answers`, async () => {
    const job = await client.getJob({ name: JOB });
    assert.equal(job.name, JOB);
    assert.equal(job.state, 3);
  });

  test(`${kind}: an error has its code, words and details`, async () => {
    const error = await fails(Code.NotFound, client.getJob({ name: "jobs/none" }));
    assert.match(error.rawMessage, /there is no job jobs\/none/);
    const types = error.details.map((detail) => detail.type ?? detail.desc?.typeName);
    assert.ok(types.includes("google.rpc.ErrorInfo"), `${types}`);
  });

  test(`${kind}: a stream comes whole and ends`, async () => {
    const messages = await all(client.watchJob({ name: JOB }));
    assert.equal(messages[0].snapshot.name, JOB);
    const events = messages.flatMap((message) => message.events);
    assert.equal(events.at(-1).payload.case, "stateChanged");
    const chunk = events.find((event) => event.payload.case === "frameChunk").payload.value;
    assert.equal(chunk.columns[0].values.length, 8 * chunk.samples);
  });

  test(`${kind}: a stream that fails says why`, async () => {
    await fails(Code.NotFound, all(client.watchJob({ name: "jobs/none" })));
  });

  test(`${kind}: a deadline ends a stream`, async () => {
    await fails(Code.DeadlineExceeded, all(client.watchJobs({}, { timeoutMs: 300 })));
  });

  test(`${kind}: a client may leave a stream`, async () => {
    const leave = new AbortController();
    await fails(Code.Canceled, (async () => {
      for await (const _ of client.watchJobs({}, { signal: leave.signal })) leave.abort();
    })());
  });

  test(`${kind}: a request that breaks a rule lists what is wrong`, async () => {
    const error = await fails(Code.InvalidArgument, client.listJobs({ pageSize: -1 }));
    assert.match(JSON.stringify(error.details), /BadRequest/);
  });

  test(`${kind}: metadata may be bytes`, async () => {
    const headers = { "x-note": "a note", "x-note-bin": "AP8" };
    assert.ok((await client.getServerInfo({}, { headers })).version);
  });
}

test("grpc-web of grpc.io: unary calls, streams and errors, in text and bytes", async () => {
  globalThis.XMLHttpRequest = xhr2.XMLHttpRequest;
  for (const format of ["text", "binary"]) {
    const client = new grpcWeb.GrpcWebClientBase({ format });
    const method = (name, type) => {
      const { input: asked, output } = service.methods.find((one) => one.name === name);
      return new grpcWeb.MethodDescriptor(
        `/contact.v1.JobService/${name}`, type, Object, Object,
        (message) => toBinary(asked, message), (bytes) => fromBinary(output, bytes));
    };
    const call = (name, type, message) => [
      `${SERVER}/contact.v1.JobService/${name}`, create(input(`${name}Request`), message), {},
      method(name, type)];
    const job = await client.unaryCall(...call("GetJob", "unary", { name: JOB }));
    assert.equal(job.name, JOB);
    await assert.rejects(client.unaryCall(...call("GetJob", "unary", { name: "jobs/none" })),
                         (error) => error.code === 5 && /there is no job/.test(error.message));
    if (format === "binary") continue;  // Its streams are text only.
    const stream = client.serverStreaming(...call("WatchJob", "server_streaming", { name: JOB }));
    const events = await new Promise((resolve, reject) => {
      const seen = [];
      stream.on("data", (message) => seen.push(...message.events));
      stream.on("error", reject);
      stream.on("end", () => resolve(seen));
    });
    assert.equal(events.at(-1).payload.case, "stateChanged");
  }
});

const BUF = "node_modules/@bufbuild/buf-linux-x64/bin/buf";
const noBuf = existsSync(BUF) ? false : "buf is there for Linux on x64 only";

for (const [protocol, ...flags] of [["connect"], ["grpcweb"], ["grpc", "--http2-prior-knowledge"],
                                    ["connect", "--http2-prior-knowledge"]]) {
  test(`buf curl by ${protocol} ${flags}`, { skip: noBuf }, async () => {
    const run = (method, message) => promisify(execFile)(
      BUF, ["curl", "--schema", DESCRIPTORS, "--protocol", protocol, ...flags, "-d",
            JSON.stringify(message), `${SERVER}/contact.v1.JobService/${method}`],
      { maxBuffer: 1 << 26 });
    assert.equal(JSON.parse((await run("GetJob", { name: JOB })).stdout).name, JOB);
    assert.match((await run("WatchJob", { name: JOB })).stdout, /stateChanged/);
    await assert.rejects(run("GetJob", { name: "jobs/none" }),
                         (error) => /not_found/.test(error.stderr));
  });
}
