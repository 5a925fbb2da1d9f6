// A page of YAML with line numbers, marks at lines, and completion.

import {useEffect, useLayoutEffect, useRef, useState} from 'preact/hooks';

import {placeAt, suggestionsAt, type Suggestion} from '../../model/completion';
import type {Problem} from '../../model/scenario_text';

interface Props {
  text: string;
  setText: (text: string) => void;
  problems: Problem[];
}

/** A place in the editor, in px. */
interface Point {
  left: number;
  top: number;
}

const MOST = 12;

/** The place below a character of the text. */
function below(area: HTMLTextAreaElement, character: number): Point {
  const before = area.value.slice(0, character).split('\n');
  const {font, paddingLeft, paddingTop, lineHeight} = getComputedStyle(area);
  const pen = document.createElement('canvas').getContext('2d')!;
  pen.font = font;
  return {
    left: area.offsetLeft + area.clientLeft + parseFloat(paddingLeft) + pen.measureText(before.at(-1)!).width - area.scrollLeft,
    top: area.offsetTop + parseFloat(paddingTop) + before.length * parseFloat(lineHeight) - area.scrollTop,
  };
}

export function Editor({text, setText, problems}: Props) {
  const area = useRef<HTMLTextAreaElement>(null);
  const gutter = useRef<HTMLDivElement>(null);
  const cursor = useRef<number | undefined>(undefined);
  const [offers, setOffers] = useState<Suggestion[]>([]);
  const [caret, setCaret] = useState<Point>({left: 0, top: 0});
  const [at, setAt] = useState(0);
  const wrong = new Map(problems.map(({line, text: what}) => [line, what]));
  useLayoutEffect(() => {
    if (cursor.current === undefined) return;
    area.current!.setSelectionRange(cursor.current, cursor.current);
    cursor.current = undefined;
  });
  useEffect(() => setAt(0), [offers]);

  const look = (force: boolean) => {
    const {value, selectionStart} = area.current!;
    const {prefix} = placeAt(value, selectionStart);
    setCaret(below(area.current!, selectionStart - prefix.length));
    setOffers(force || prefix.length > 0 ? suggestionsAt(value, selectionStart).filter(({word}) => word !== prefix).slice(0, MOST) : []);
  };
  const take = ({word}: Suggestion) => {
    const {value, selectionStart} = area.current!;
    const {prefix, key} = placeAt(value, selectionStart);
    const added = word + (key ? '' : ': ');
    cursor.current = selectionStart - prefix.length + added.length;
    setText(value.slice(0, selectionStart - prefix.length) + added + value.slice(selectionStart));
    setOffers([]);
    area.current!.focus();
  };
  const press = (event: KeyboardEvent) => {
    if (event.key === ' ' && event.ctrlKey) { event.preventDefault(); look(true); return; }
    if (offers.length === 0) return;
    const step = {ArrowDown: 1, ArrowUp: -1}[event.key];
    if (step) setAt((at + step + offers.length) % offers.length);
    else if (event.key === 'Enter') take(offers[at]!);
    else if (event.key === 'Escape') setOffers([]);
    else return;
    event.preventDefault();
  };
  return (
    <div class="editor">
      <div class="lines" ref={gutter} aria-hidden="true">{text.split('\n').map((_, i) => (
        <div key={i} class={wrong.has(i + 1) ? 'wrong' : ''} title={wrong.get(i + 1)}>{wrong.has(i + 1) ? '✗ ' : ''}{i + 1}</div>))}</div>
      <textarea ref={area} value={text} spellcheck={false} wrap="off" aria-label="Scenario, YAML; Ctrl and space completes" aria-autocomplete="list"
        rows={Math.min(Math.max(text.split('\n').length + 1, 16), 34)}
        onInput={(e) => { setText(e.currentTarget.value); look(false); }} onKeyDown={press} onBlur={() => setTimeout(() => setOffers([]), 150)}
        onScroll={(e) => { gutter.current!.scrollTop = e.currentTarget.scrollTop; }} />
      {offers.length > 0 && (
        <ul class="offers" role="listbox" aria-label="Completion" style={{left: `min(${caret.left}px, 45%)`, top: `${caret.top}px`}}>{offers.map((offer, i) => (
          <li key={offer.word} role="option" aria-selected={i === at} onMouseDown={(e) => { e.preventDefault(); take(offer); }}>
            <span class="mono">{offer.word}</span> <span class="soft">{offer.about}</span></li>))}</ul>)}
    </div>
  );
}
