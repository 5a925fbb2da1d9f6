// A button that copies.

import {useState} from 'preact/hooks';

/** Copies a text; says so until the pointer or the focus leaves. */
export function Copy({text, what, children = 'Copy'}: {text: string | (() => string); what: string; children?: string}) {
  const [said, setSaid] = useState('');
  const copy = () => {
    const copied = navigator.clipboard?.writeText(typeof text === 'string' ? text : text()) ?? Promise.reject(new Error('no clipboard'));
    copied.then(() => setSaid('Copied'), () => setSaid('Mark the text to copy it'));
  };
  return <button type="button" aria-label={said ? undefined : `Copy ${what}`} onClick={copy} onBlur={() => setSaid('')} onMouseLeave={() => setSaid('')}>
    <span role="status">{said || children}</span></button>;
}
