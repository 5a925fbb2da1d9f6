// Looks at plain objects before they are sent: what the contract has not is told, and not left out.

import protobuf from 'protobufjs';

/** A field that is not as it must be. */
export interface Violation {
  /** Path of the field, such as `contacts[0].restitution`. */
  field: string;
  description: string;
  /** What to do about it; may be empty. */
  hint: string;
}

const WHOLE = /^(s?fixed|[us]?int)(32|64)$/;

function expectedOf(type: string): string {
  if (WHOLE.test(type)) return 'a whole number';
  return {double: 'a number', float: 'a number', bool: 'true or false', string: 'a text',
          bytes: 'a Buffer'}[type] ?? type;
}

function fits(type: string, value: unknown): boolean {
  if (type === 'string') return typeof value === 'string';
  if (type === 'bool') return typeof value === 'boolean';
  if (type === 'bytes') return value instanceof Uint8Array || typeof value === 'string';
  if (!WHOLE.test(type)) return typeof value === 'number';
  return Number.isInteger(value) || (typeof value === 'string' && /^-?\d+$/.test(value));
}

/** How many letters must change to make one word of the other. */
function distance(a: string, b: string): number {
  let row = Array.from({length: b.length + 1}, (_, place) => place);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let j = 1; j <= b.length; ++j) {
      const change = row[j - 1]! + Number(a[i - 1] !== b[j - 1]);
      next.push(Math.min(change, row[j]! + 1, next[j - 1]! + 1));
    }
    row = next;
  }
  return row[b.length]!;
}

/** The words near to one that is none of them, else all. */
function nearest(word: string, words: string[], what: string): string {
  const near = words.filter((other) => distance(word.toLowerCase(), other.toLowerCase())
    <= Math.ceil(Math.min(word.length, other.length) / 3) || other.startsWith(word));
  return near.length > 0 ? `did you mean ${near.slice(0, 3).map((each) => `'${each}'`).join(' or ')}?`
    : `${what} ${words.join(', ')}`;
}

function shown(value: unknown): string {
  if (Array.isArray(value)) return 'a list';
  return typeof value === 'object' && value !== null ? 'an object' : `'${String(value)}'`;
}

function single(type: protobuf.Type | protobuf.Enum | null, name: string, value: unknown,
                path: string, found: Violation[]): void {
  const refuse = (expected: string) =>
    found.push({field: path, description: `expected ${expected}, got ${shown(value)}`, hint: ''});
  if (type instanceof protobuf.Enum) {
    const words = Object.keys(type.values);
    if (typeof value === 'number' ? value in type.valuesById : words.includes(String(value))) return;
    const known = words.filter((word) => type.values[word] !== 0);
    found.push({field: path, description: `unknown value '${String(value)}'`,
                hint: nearest(String(value), known, 'one of')});
  } else if (type) {
    message(type, value, path, found);
  } else if (!fits(name, value)) {
    refuse(expectedOf(name));
  }
}

function message(type: protobuf.Type, value: unknown, path: string, found: Violation[]): void {
  if (typeof value !== 'object' || value === null || Array.isArray(value)) {
    found.push({field: path, description: `expected an object, got ${shown(value)}`, hint: ''});
    return;
  }
  for (const [name, part] of Object.entries(value)) {
    const place = path ? `${path}.${name}` : name;
    const field = type.fields[name]?.resolve();
    if (!field) {
      if (type.oneofs?.[name]) continue; // As answers have it: which of its fields is set.
      found.push({field: place, description: 'unknown field',
                  hint: nearest(name, Object.keys(type.fields), 'fields are')});
    } else if (part === undefined || part === null) {
      continue;
    } else if (field.map) {
      if (typeof part !== 'object' || Array.isArray(part)) {
        found.push({field: place, description: `expected an object, got ${shown(part)}`, hint: ''});
        continue;
      }
      for (const [key, entry] of Object.entries(part)) {
        single(field.resolvedType, field.type, entry, `${place}[${key}]`, found);
      }
    } else if (field.repeated) {
      if (!Array.isArray(part)) {
        found.push({field: place, description: `expected a list, got ${shown(part)}`, hint: ''});
        continue;
      }
      part.forEach((entry, index) =>
        single(field.resolvedType, field.type, entry, `${place}[${index}]`, found));
    } else {
      single(field.resolvedType, field.type, part, place, found);
    }
  }
}

/** The messages of the contract, for those who look at values. */
export class Messages {
  private readonly root: protobuf.Root;

  /** @param protoDir the folder that holds contact/v1 */
  constructor(protoDir: string) {
    this.root = new protobuf.Root();
    this.root.resolvePath = (_, target) =>
      target.startsWith('google/protobuf/') ? target : `${protoDir}/${target}`; // protobufjs has these.
    this.root.loadSync(['contact/v1/job_service.proto', 'google/rpc/status.proto',
                        'google/rpc/error_details.proto'], {keepCase: true});
  }

  /** What is wrong with an object that shall become a message of this type; all of it. */
  violations(type: string, value: unknown): Violation[] {
    const found: Violation[] = [];
    message(this.root.lookupType(type), value, '', found);
    return found;
  }

  /** The message of these bytes as an object. */
  decode(type: string, bytes: Uint8Array): Record<string, any> {
    const known = this.root.lookupType(type);
    return known.toObject(known.decode(bytes), {arrays: true, objects: true, defaults: true});
  }
}
