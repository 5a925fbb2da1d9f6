// SVG, PNG and CSV of a plot.

import {useEffect, useRef} from 'preact/hooks';
import type uPlot from 'uplot';

import {panelCsv, without, type Panel} from '../model/panel';
import {save} from '../ui/save';
import {svgOf, type Svg} from './svg';

interface Props {
  panel: Panel;
  /** Names of curves that its SVG and PNG leave out. */
  hidden: Set<string>;
  plot: {current: uPlot | undefined};
  source: string;
  /** Draws what waits to be drawn. */
  flush: () => void;
}

const PNG_SCALE = 2;

/** How the figures of the page are drawn, for its report. */
export const drawings = new WeakMap<Element, () => Svg>();

/** Draws an SVG into a PNG. */
export async function pngOf(svg: string, width: number, height: number): Promise<Blob> {
  const image = new Image();
  image.src = URL.createObjectURL(new Blob([svg], {type: 'image/svg+xml'}));
  await image.decode();
  const canvas = Object.assign(document.createElement('canvas'), {width: width * PNG_SCALE, height: height * PNG_SCALE});
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(image.src);
  return new Promise((resolve) => canvas.toBlob((blob) => resolve(blob!), 'image/png'));
}

/** The three buttons of a figure. `title` tells them from those of other figures. */
export function ExportButtons({title, name, svg, csv}: {title: string; name: string; svg: () => Svg; csv: () => string}) {
  const place = useRef<HTMLSpanElement>(null);
  useEffect(() => { drawings.set(place.current!.closest('figure')!, svg); });
  const file = name.replace(/[^\w.-]+/g, '-');
  const png = async () => {
    const {width, height, text} = svg();
    save(`${file}.png`, await pngOf(text, width, height));
  };
  return (
    <span class="exports" ref={place}>
      <button type="button" aria-label={`${title} as SVG`}
        onClick={() => save(`${file}.svg`, new Blob([svg().text], {type: 'image/svg+xml'}))}>SVG</button>
      <button type="button" aria-label={`${title} as PNG`} onClick={() => void png()}>PNG</button>
      <button type="button" aria-label={`${title} as CSV`}
        onClick={() => save(`${file}.csv`, new Blob([csv()], {type: 'text/csv'}))}>CSV</button>
    </span>
  );
}

export function Exports({panel, hidden, plot, source, flush}: Props) {
  const svg = () => {
    flush();
    return svgOf(without(panel, hidden), plot.current!, source);
  };
  return <ExportButtons title={panel.title} name={`${source}-${panel.id}`} svg={svg} csv={() => panelCsv(panel)} />;
}
