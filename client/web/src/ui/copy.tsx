// Buttons that copy.

import {useState} from 'preact/hooks';

/** Copies a text: where the page came without TLS, so that it has no clipboard, by marking it. */
async function copied(text: string): Promise<void> {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const focus = document.activeElement as HTMLElement | null;
  const area = document.body.appendChild(Object.assign(document.createElement('textarea'), {value: text}));
  area.select();
  const done = document.execCommand('copy');
  area.remove();
  focus?.focus();
  if (!done) throw new Error('no clipboard');
  return undefined;
}

/** Copies a text; says so until the pointer or the focus leaves. */
export function Copy({text, what, children = 'Copy'}: {text: string | (() => string); what: string; children?: string}) {
  const [said, setSaid] = useState('');
  const copy = () => {
    copied(typeof text === 'string' ? text : text()).then(() => setSaid('Copied'), () => setSaid('Mark the text to copy it'));
  };
  return <button type="button" aria-label={said ? undefined : `Copy ${what}`} onClick={copy} onBlur={() => setSaid('')} onMouseLeave={() => setSaid('')}>
    <span role="status">{said || children}</span></button>;
}

/** Copies the address of the page, which holds all that is chosen on it. */
export function CopyLink() {
  return <Copy text={() => location.href} what="link to this view">Copy link</Copy>;
}
