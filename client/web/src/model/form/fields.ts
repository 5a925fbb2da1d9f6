// What a form asks of each object of a scenario, from its JSON schema.

import schema from '../../../../scenarios/contact.schema.json';

export type Kind = 'number' | 'integer' | 'text' | 'truth' | 'word' | 'numbers' | 'texts' | 'object' | 'objects';

/** One field of an object. */
export interface FormField {
  name: string;
  kind: Kind;
  /** What it means, with its range and default. */
  about: string;
  required: boolean;
  /** Of a word: those that it may be, each with its meaning. */
  words: {word: string; about: string}[];
  low: number | undefined;
  high: number | undefined;
  /** What it is where it is not given, as a text; empty if that depends on others. */
  standard: string;
  /** Of an object or objects: what they are, a name for `fieldsOf`. */
  type: string;
}

interface Node {
  $ref?: string;
  type?: string;
  description?: string;
  enum?: string[];
  enumDescriptions?: string[];
  anyOf?: Node[];
  allOf?: Node[];
  oneOf?: Node[];
  items?: Node;
  properties?: Record<string, Node>;
  required?: string[];
  minimum?: number;
  exclusiveMinimum?: number;
  maximum?: number;
  default?: unknown;
}

const definitions = (schema as unknown as {definitions: Record<string, Node>}).definitions;
const typeOf = ({$ref = ''}: Node) => $ref.replace('#/definitions/', '');

/** A value without the choice of a variable in its place. */
const plain = (node: Node): Node => node.anyOf?.find((one) => typeOf(one) !== 'variable') ?? node;

function kindOf(node: Node, type: string): Kind {
  if (type) return 'object';
  if (node.enum) return 'word';
  if (node.type === 'array') {
    const entry = plain(node.items!);
    return typeOf(entry) ? 'objects' : entry.type === 'string' ? 'texts' : 'numbers';
  }
  if (node.type === 'boolean') return 'truth';
  return node.type === 'number' || node.type === 'integer' ? node.type : 'text';
}

function fieldOf(name: string, node: Node, required: boolean): FormField {
  const value = plain(node);
  const type = typeOf(node.allOf?.[0] ?? value);
  return {
    name, kind: kindOf(value, type), about: node.description ?? '', required,
    words: (value.enum ?? []).map((word, i) => ({word, about: value.enumDescriptions?.[i] ?? ''})),
    low: value.minimum ?? value.exclusiveMinimum, high: value.maximum,
    standard: node.default === undefined ? '' : String(node.default),
    type: type || typeOf(value.items ?? {}),
  };
}

/** The fields of an object such as `Body`, in their order. `variables` of a file are no field. */
export function fieldsOf(type: string): FormField[] {
  const {properties = {}, required = []} = definitions[type] ?? {};
  return Object.entries(properties).filter(([name]) => name !== 'variables')
    .map(([name, node]) => fieldOf(name, node, required.includes(name)));
}

/** The fields of an object of which it has exactly one, such as the kinds of a load; none if it may have all. */
export function choicesOf(type: string): string[] {
  return (definitions[type]?.allOf ?? []).flatMap(({oneOf = []}) => oneOf.flatMap((one) => one.required ?? []));
}

/** What an object is, in a few sentences. */
export const aboutOf = (type: string): string => definitions[type]?.description ?? '';
