// Steps back and forth in the text of the editor, whoever has changed it.

import {useEffect, useLayoutEffect, useRef, useState} from 'preact/hooks';

import {begun, changed, endOfChange, redone, undone, type History} from '../../model/form/history';

interface Undo {
  /** Takes a new text. Changes by the same one in quick order are one step. */
  change: (text: string, by: string) => void;
  undo: () => void;
  redo: () => void;
  canUndo: boolean;
  canRedo: boolean;
  /** Takes the keys for a step back or forth. */
  press: (event: KeyboardEvent) => void;
}

export function useUndo(text: string, setText: (text: string) => void): Undo {
  const history = useRef<History>(begun(text));
  const caret = useRef<{area: HTMLTextAreaElement; at: number} | undefined>(undefined);
  const [, show] = useState(0);
  useLayoutEffect(() => {   // A browser puts it at the end of a text that it is given.
    caret.current?.area.setSelectionRange(caret.current.at, caret.current.at);
    caret.current = undefined;
  });
  useEffect(() => {   // What the address brings is a step, too; the first text that is read is where all begins.
    if (text === history.current.text) return;
    history.current = history.current.text === '' ? begun(text) : changed(history.current, text, '', 0);
    show((n) => n + 1);
  }, [text]);
  const to = (next: History) => {
    history.current = next;
    setText(next.text);
    show((n) => n + 1);
  };
  const undo = () => to(undone(history.current));
  const redo = () => to(redone(history.current));
  const press = (event: KeyboardEvent) => {
    const key = event.key.toLowerCase();
    if (event.target instanceof HTMLInputElement) return;   // It has steps of its own.
    if (!(event.ctrlKey || event.metaKey) || event.altKey || (key !== 'z' && key !== 'y')) return;
    event.preventDefault();
    const before = history.current.text;
    (key === 'y' || event.shiftKey ? redo : undo)();
    const at = endOfChange(before, history.current.text);
    if (event.target instanceof HTMLTextAreaElement) caret.current = {area: event.target, at};
  };
  return {
    change: (next, by) => to(changed(history.current, next, by, Date.now())), undo, redo, press,
    canUndo: history.current.past.length > 0, canRedo: history.current.future.length > 0,
  };
}
