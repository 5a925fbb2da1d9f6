// The scenarios of client/scenarios, as they were when the dashboard was built.

const files = import.meta.glob('../../../scenarios/*.yaml', {query: '?raw', import: 'default', eager: true}) as Record<string, string>;

/** Pages of YAML by file name. */
export const templates: Record<string, string> = Object.fromEntries(
  Object.entries(files).map(([path, text]) => [path.slice(path.lastIndexOf('/') + 1), text]));

/** What a template shows, in a line. */
export function titleOf(name: string): string {
  const text = templates[name] ?? '';
  return /^title: *(.+)$/m.exec(text)?.[1]?.replace(/^"(.*)"$/, '$1') ?? (/^axes:/m.test(text) ? `Sweep: ${name.replace('.yaml', '')}` : name);
}
