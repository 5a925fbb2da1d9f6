// What can be done by keys, told when `?` is pressed.

import {useEffect, useRef} from 'preact/hooks';

const KEYS: [string, [string, string][]][] = [
  ['Everywhere', [['?', 'these keys'], ['Esc', 'close them']]],
  ['Plots of a run', [['+ −', 'zoom in and out'], ['[ ]', 'earlier, later'], ['0', 'all the time'], ['← →', 'on the slider: move the moment whose values all plots tell']]],
  ['Cells of a sweep', [['← → ↑ ↓', 'choose a cell'], ['Enter', 'run the cell chosen'], ['↑ ↓', 'on an end of an axis: choose a range'], ['Esc', 'choose all cells again']]],
  ['Editor of a scenario', [['Ctrl Space', 'complete a word'], ['↑ ↓ Enter', 'choose among completions'], ['Ctrl Z', 'a step back, also of the form'], ['Ctrl Y', 'forward again']]],
];

/** A button with the keys behind it; `?` opens them too, but where words are written. */
export function Keys() {
  const dialog = useRef<HTMLDialogElement>(null);
  const open = () => { if (!dialog.current!.open) dialog.current!.showModal(); };
  useEffect(() => {
    const press = (event: KeyboardEvent) => {
      if (event.key === '?' && !(event.target as Element).closest('input, select, textarea')) open();
    };
    addEventListener('keydown', press);
    return () => removeEventListener('keydown', press);
  }, []);
  return (
    <>
      <button type="button" class="quiet" aria-label="Keys" title="keys (?)" onClick={open}>?</button>
      <dialog ref={dialog} class="shortcuts" aria-label="Keys">
        {KEYS.map(([where, keys]) => (
          <section key={where}><h2>{where}</h2>
            <dl>{keys.map(([key, what]) => <div key={key}><dt><kbd>{key}</kbd></dt><dd>{what}</dd></div>)}</dl></section>))}
        <button type="button" onClick={() => dialog.current!.close()}>Close</button>
      </dialog>
    </>
  );
}
