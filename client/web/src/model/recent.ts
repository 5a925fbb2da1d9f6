// The newest values by their keys.

/** Keeps as many values as it may, and forgets the one that was put or got the longest ago. */
export class Recent<Value> {
  private readonly values = new Map<string, Value>();   // The oldest first.

  constructor(private readonly most: number) {}

  get(key: string): Value | undefined {
    const value = this.values.get(key);
    if (value !== undefined) this.put(key, value);
    return value;
  }

  put(key: string, value: Value): void {
    this.values.delete(key);
    this.values.set(key, value);
    if (this.values.size > this.most) this.values.delete(this.values.keys().next().value!);
  }
}
