// Dark and light: as the system says, or as chosen. Colours and dashes of curves are those of contactsim's
// figures, which people with any colour vision can tell apart.

import {useEffect, useState} from 'preact/hooks';

import look from '../../../python/contactsim/figures/words.json';

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

/** The colour of a curve. */
export function colourOf(place: number, shown: Theme): string {
  const palette = shown === 'dark' ? look.palette_on_dark : look.palette;
  return palette[place % palette.length]!;
}

// There is no room for names beside the curves of a narrow page.
const narrow = matchMedia('(max-width: 560px)');

/** The dashes of a curve, which is 1.6 pixels wide: other ones for each turn of the palette, on narrow pages for each curve. */
export function dashOf(place: number): number[] {
  const turn = narrow.matches ? place : Math.floor(place / look.palette.length);
  return look.dashes[turn % look.dashes.length]!.map((widths) => 1.6 * widths);
}
