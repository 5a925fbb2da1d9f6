// Asking before what cannot be taken back.

import {useState} from 'preact/hooks';

/** A button for what cannot be taken back: it asks whether that is meant. */
export function Twice({first, then, stay, act}: {first: string; then: string; stay: string; act: () => void}) {
  const [sure, setSure] = useState(false);
  if (!sure) return <button type="button" onClick={() => setSure(true)}>{first}</button>;
  return (
    <>
      <button type="button" class="danger" onClick={() => { setSure(false); act(); }}>{then}</button>
      <button type="button" onClick={() => setSure(false)}>{stay}</button>
    </>
  );
}
