// The width of an element, as it changes.

import {useLayoutEffect, useRef, useState} from 'preact/hooks';

/** A reference for an element, and its width in px; `first` until it is known. */
export function useWidth(first: number): [{current: HTMLDivElement | null}, number] {
  const box = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(first);
  useLayoutEffect(() => {
    const look = () => setWidth(box.current?.clientWidth || first);
    const observer = new ResizeObserver(look);
    observer.observe(box.current!);
    look();
    return () => observer.disconnect();
  }, []);
  return [box, width];
}
