// Calls of one kind, one at a time: what is wanted while one is under way is called once, after it.

/** How a call ended: how long one that has time waits after it, and whether it is to be made again. */
export interface Rest {
  pauseMs: number;
  again?: boolean;
}

type Want = 'nothing' | 'later' | 'now';

/** Makes a call whose newest form is the one that counts. `call` must not fail. */
export class Turns {
  #busy = false;
  #ended = false;
  #want: Want = 'nothing';
  #free = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly call: () => Promise<Rest>) {}

  /** Calls at once, or as soon as the call that is under way has ended. */
  now(): void { this.#wish('now'); }

  /** Calls when the pause after the last call is over. */
  later(): void { this.#wish('later'); }

  /** Makes no further call. */
  end(): void {
    clearTimeout(this.#timer);
    this.#ended = true;
  }

  #wish(want: Want): void {
    if (this.#ended || want === 'nothing') return;
    clearTimeout(this.#timer);
    if (this.#busy) this.#want = this.#want === 'now' ? 'now' : want;
    else if (want === 'now') void this.#turn();
    else this.#timer = setTimeout(() => this.now(), this.#free - performance.now());
  }

  async #turn(): Promise<void> {
    this.#busy = true;
    this.#want = 'nothing';
    const {pauseMs, again} = await this.call();
    this.#busy = false;
    this.#free = performance.now() + pauseMs;
    this.#wish(again && this.#want === 'nothing' ? 'later' : this.#want);
  }
}
