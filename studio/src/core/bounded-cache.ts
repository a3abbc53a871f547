/** Things that are dear to load and to keep: shared while in use, kept a while after, then let go. */

interface Entry<T> {
  readonly loading: Promise<T | null>;
  value: T | null;
  users: number;
}

export interface CacheCalls<K, T> {
  /** Null where it cannot be had; asked for again, it is tried again. */
  load(key: K): Promise<T | null>;
  cost(value: T): number;
  dispose(value: T): void;
  /** Nobody waits any longer for what is on its way; true where it will not come then. */
  cancel?(key: K): boolean;
}

export class BoundedCache<K, T> {
  readonly #entries = new Map<K, Entry<T>>();
  readonly #calls: CacheCalls<K, T>;
  readonly #most: number;

  /** What is in use is kept even beyond `most`, the sum of costs. */
  constructor(most: number, calls: CacheCalls<K, T>) {
    this.#most = most;
    this.#calls = calls;
  }

  /** Each call that gave a value wants one of `release`; so does one that is no longer waited for. */
  async acquire(key: K): Promise<T | null> {
    const entry = this.#entries.get(key) ?? { loading: this.#calls.load(key), value: null, users: 0 };
    // The most recently used is the last.
    this.#entries.delete(key);
    this.#entries.set(key, entry);
    entry.users += 1;
    const value = await entry.loading;
    if (value === null) {
      if (this.#entries.get(key) === entry) this.#entries.delete(key);
      return null;
    }
    entry.value = value;
    this.#shrink();
    return value;
  }

  release(key: K): void {
    const entry = this.#entries.get(key);
    if (entry === undefined) return;
    entry.users = Math.max(0, entry.users - 1);
    if (entry.users === 0 && entry.value === null && this.#calls.cancel?.(key) === true) this.#entries.delete(key);
    this.#shrink();
  }

  get size(): number {
    return this.#entries.size;
  }

  get cost(): number {
    let sum = 0;
    for (const { value } of this.#entries.values()) if (value !== null) sum += this.#calls.cost(value);
    return sum;
  }

  /** Lets go of all, used or not; what is still on its way is let go when it arrives. */
  dispose(): void {
    for (const { loading } of this.#entries.values()) {
      void loading.then((value) => {
        if (value !== null) this.#calls.dispose(value);
      });
    }
    this.#entries.clear();
  }

  #shrink(): void {
    let cost = this.cost;
    for (const [key, { value, users }] of this.#entries) {
      if (cost <= this.#most) return;
      if (value === null || users > 0) continue;
      this.#entries.delete(key);
      cost -= this.#calls.cost(value);
      this.#calls.dispose(value);
    }
  }
}
