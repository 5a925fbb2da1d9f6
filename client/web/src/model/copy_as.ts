// The same job from a shell, from Python, and by curl.

import type {JsonValue} from '@bufbuild/protobuf';

/** For contactctl; needs no file. */
export function asCli(text: string, kind: 'scenario' | 'sweep'): string {
  return `contactctl ${kind === 'sweep' ? 'sweep run' : 'run'} - <<'END'\n${text.trimEnd()}\nEND\n`;
}

/** JSON as a literal of Python. */
export function pythonLiteral(value: JsonValue, indent = ''): string {
  const deeper = `${indent}    `;
  if (value === null) return 'None';
  if (value === true) return 'True';
  if (value === false) return 'False';
  if (Array.isArray(value)) return `[${value.map((entry) => pythonLiteral(entry, indent)).join(', ')}]`;
  if (typeof value !== 'object') return JSON.stringify(value);
  const rows = Object.entries(value).map(([k, v]) => [JSON.stringify(k), v!] as const);
  if (indent) return `{${rows.map(([k, v]) => `${k}: ${pythonLiteral(v, deeper)}`).join(', ')}}`;
  return `{\n${rows.map(([k, v]) => `    ${k}: ${pythonLiteral(v, deeper)},`).join('\n')}\n}`;
}

/** For the package contactsim. */
export function asPython(json: JsonValue): string {
  return `import contactsim\n\nresult = contactsim.Client().run(${pythonLiteral(json)})\n`
    + 'print(result.cycles)\n';
}

/** For curl. */
export function asCurl(json: JsonValue, kind: 'scenario' | 'sweep', origin: string): string {
  return `curl -H 'content-type: application/json' -d @- ${origin}/contact.v1.JobService/CreateJob <<'END'\n`
    + `${JSON.stringify({job: {[kind]: json}}, null, 1)}\nEND\n`;
}
