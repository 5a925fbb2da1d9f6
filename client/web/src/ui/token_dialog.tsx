// Asks for the token where the server wants one.

import {useEffect, useRef, useState} from 'preact/hooks';

import {onTokenWanted, setToken, token} from '../api/token';

export function TokenDialog({onToken}: {onToken: () => void}) {
  const [wanted, setWanted] = useState(false);
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => onTokenWanted(() => setWanted(true)), []);
  useEffect(() => { if (wanted) field.current?.focus(); }, [wanted]);
  if (!wanted) return null;
  const submit = (event: Event) => {
    event.preventDefault();
    setToken(field.current!.value);
    setWanted(false);
    onToken();
  };
  return (
    <form class="notice asks" onSubmit={submit} role="alert">
      <label>
        {token() ? 'The server does not take this token. Another token' : 'This server asks who calls. Token'}
        <input ref={field} type="password" autocomplete="off" required />
      </label>
      <button type="submit">Use it</button>
      <span class="soft">It is kept until this tab is closed.</span>
    </form>
  );
}
