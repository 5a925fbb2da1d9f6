/** A new id of a request. `crypto.randomUUID` is missing on pages without TLS. */
export function requestId(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, '0')).join('');
}
