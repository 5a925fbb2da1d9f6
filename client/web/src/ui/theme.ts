// Dark and light: as the system says, or as chosen. Colours of curves are those of contactctl's
// figures, which people with any colour vision can tell apart.

import {useEffect, useState} from 'preact/hooks';

export type Theme = 'light' | 'dark';
const KEY = 'contact.theme';
const dark = matchMedia('(prefers-color-scheme: dark)');
const listeners = new Set<() => void>();

/** The theme that is shown. */
export function theme(): Theme {
  const chosen = localStorage.getItem(KEY);
  if (chosen === 'light' || chosen === 'dark') return chosen;
  return dark.matches ? 'dark' : 'light';
}

function apply(): void {
  document.documentElement.dataset.theme = theme();
  for (const told of listeners) told();
}

/** Shows the other theme from now on. */
export function switchTheme(): void {
  localStorage.setItem(KEY, theme() === 'dark' ? 'light' : 'dark');
  apply();
}

export function startTheme(): void {
  apply();
  dark.addEventListener('change', apply);
}

/** The theme, as it changes. */
export function useTheme(): Theme {
  const [shown, setShown] = useState(theme);
  useEffect(() => {
    const told = () => setShown(theme());
    listeners.add(told);
    return () => { listeners.delete(told); };
  }, []);
  return shown;
}

const LIGHT = ['#0072B2', '#D55E00', '#009E73', '#B8578F', '#A87400', '#2A86BD', '#000000'];
const DARK = ['#4FB3EA', '#FF8C42', '#2FD3A5', '#E69AC6', '#F2BC3F', '#8FD0F5', '#F0F0F0'];
const DASHES: number[][] = [[], [9, 4], [2, 3], [9, 3, 2, 3]];

/** The colour of a curve. */
export function colourOf(place: number, shown: Theme): string {
  const palette = shown === 'dark' ? DARK : LIGHT;
  return palette[place % palette.length]!;
}

// There is no room for names beside the curves of a narrow page.
const narrow = matchMedia('(max-width: 560px)');

/** The dashes of a curve: other ones for each turn of the palette, on narrow pages for each curve. */
export function dashOf(place: number): number[] {
  if (narrow.matches) return DASHES[place % DASHES.length]!;
  return DASHES[Math.floor(place / LIGHT.length) % DASHES.length]!;
}
