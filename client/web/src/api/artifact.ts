// Files that a job leaves.

import {server} from './client';

/** Reads a file to its end. */
export async function readArtifact(name: string, artifact: string): Promise<Blob> {
  const parts: Uint8Array<ArrayBuffer>[] = [];
  for await (const {data} of server.readArtifact({name, artifact})) parts.push(data as Uint8Array<ArrayBuffer>);
  return new Blob(parts, {type: 'text/csv'});
}
