// Tells that the link to the server is broken, and what becomes of it.

import type {Link} from '../api/stream';

/** It stands in the page always, so that screen readers hear what changes in it. */
export function LinkNote({link}: {link: Link}) {
  const why = 'why' in link ? link.why : '';
  return (
    <p class={why && 'notice'} role="status" data-link={link.state}>
      {why} {link.state === 'waiting' && 'Trying again; the page goes on from where it was.'}
    </p>
  );
}
