// The token by which a server that asks who calls knows the page. It is kept for the tab only, and
// never stands in an address.

const KEY = 'contact.token';
const listeners = new Set<() => void>();

/** The token, or an empty text. */
export function token(): string {
  return sessionStorage.getItem(KEY) ?? '';
}

/** Keeps a token; all later calls carry it. */
export function setToken(value: string): void {
  sessionStorage.setItem(KEY, value.trim());
}

/** Calls `ask` whenever the server refuses a call for want of a token. Returns how to stop that. */
export function onTokenWanted(ask: () => void): () => void {
  listeners.add(ask);
  return () => listeners.delete(ask);
}

/** Tells that the server wants a token. */
export function wantToken(): void {
  for (const ask of listeners) ask();
}
