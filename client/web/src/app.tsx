// The frame of all pages: navigation, token, and the view of the address.

import type {ComponentType} from 'preact';
import {useEffect, useLayoutEffect, useRef, useState} from 'preact/hooks';

import {Keys} from './ui/keys';
import {followLinks, useRoute, type Route} from './ui/route';
import {switchTheme, useTheme} from './ui/theme';
import {TokenDialog} from './ui/token_dialog';
import {Runs} from './views/list/runs';

type View = ComponentType<{route: Route}>;

/** Views that are loaded when they are first needed. */
const LAZY: Record<string, () => Promise<View>> = {
  runs: async () => (await import('./views/run/run')).Run,
  compare: async () => (await import('./views/compare')).Compare,
  new: async () => (await import('./views/new/new')).New,
  translate: async () => (await import('./views/translate/translate')).Translate,
  server: async () => (await import('./views/server')).Server,
};
const LINKS = [['/runs', 'Runs'], ['/new', 'New run'], ['/compare', 'Compare'], ['/translate', 'Translate'], ['/server', 'Server']] as const;
const loaded = new Map<string, View>();

function NotFound({route}: {route: Route}) {
  return <><div class="head"><h1>No such page</h1></div><p class="nothing">There is no page <code>{route.path}</code>. <a href="/runs">All runs</a></p></>;
}

/** The first part of an address: that of a run is `runs`, that of the list is empty. */
function kindOf(path: string): string {
  const [first = '', second] = path.split('/').filter(Boolean);
  return first === 'runs' && !second ? '' : first;
}

/** The view of an address; undefined while it is loaded. */
function useView(path: string): View | undefined {
  const [, again] = useState(0);
  const kind = kindOf(path);
  useEffect(() => {
    if (!LAZY[kind] || loaded.has(kind)) return;
    void LAZY[kind]().then((view) => { loaded.set(kind, view); again((n) => n + 1); });
  }, [kind]);
  if (LAZY[kind]) return loaded.get(kind);
  return kind ? NotFound : Runs;
}

function Navigation({path}: {path: string}) {
  const theme = useTheme();
  return (
    <header class="bar">
      <a class="brand" href="/runs">contactd</a>
      <nav aria-label="Pages">
        {LINKS.map(([href, name]) => (
          <a key={href} href={href} aria-current={(path === '/' ? '/runs' : path).startsWith(href) ? 'page' : undefined}>{name}</a>
        ))}
        <a href="/docs/" target="_top">Documentation</a>
      </nav>
      <Keys />
      <button type="button" class="quiet" onClick={switchTheme}>{theme === 'dark' ? '☀ Light' : '☾ Dark'}</button>
    </header>
  );
}

export function App() {
  const route = useRoute();
  const View = useView(route.path);
  const [session, setSession] = useState(0);
  const content = useRef<HTMLElement>(null);
  const last = useRef(route.path);
  useLayoutEffect(() => {   // A run puts its own title in its place.
    const name = LINKS.find(([href]) => `${route.path}/`.startsWith(`${href}/`))?.[1] ?? (kindOf(route.path) ? 'No such page' : 'Runs');
    document.title = `${name} · contactd`;
  }, [route.path]);
  useEffect(() => {   // The next Tab goes on in the new page.
    if (last.current !== route.path) content.current?.focus({preventScroll: true});
    last.current = route.path;
  }, [route.path]);
  return (
    <div onClick={followLinks}>
      <a class="skip" href="#content">Skip to the content</a>
      <Navigation path={route.path} />
      <TokenDialog onToken={() => setSession((n) => n + 1)} />
      <main ref={content} id="content" tabIndex={-1} key={`${route.path}-${session}`}>
        {View ? <View route={route} /> : <p class="nothing">Loading …</p>}
      </main>
    </div>
  );
}
