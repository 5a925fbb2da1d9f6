// A button that saves what a page shows.

import {save} from './save';

/** Saves the page as a report that needs no network; `jobs` are what it is about. */
export function SaveReport({jobs}: {jobs: string[]}) {
  const write = async () => {
    const {reportOf} = await import('../plots/report');
    const port = location.port || (location.protocol === 'https:' ? '443' : '80');
    const repeat = jobs.map((name) => `contactctl --server ${location.hostname}:${port} run --like ${name}`).join('\n');
    save(`${jobs.join(' ').replace(/[^\w.-]+/g, '-')}.html`, new Blob([reportOf(document.querySelector('main')!, repeat)], {type: 'text/html'}));
  };
  return <button type="button" onClick={() => void write()}>Save report</button>;
}
