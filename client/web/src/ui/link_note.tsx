// Tells that the link to the server is broken, and what becomes of it.

import type {Link} from '../api/stream';

export function LinkNote({link}: {link: Link}) {
  if (!('why' in link)) return <span class="link" data-link={link.state} />;
  return (
    <p class="notice" role="status" data-link={link.state}>
      {link.why} {link.state === 'waiting' && 'Trying again; the page goes on from where it was.'}
    </p>
  );
}
