// SVG, PNG and CSV of a plot.

import type uPlot from 'uplot';

import {panelCsv, type Panel} from '../model/panel';
import {save} from '../ui/save';
import {svgOf} from './svg';

interface Props {
  panel: Panel;
  plot: {current: uPlot | undefined};
  source: string;
  /** Draws what waits to be drawn. */
  flush: () => void;
}

const PNG_SCALE = 2;

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

export function Exports({panel, plot, source, flush}: Props) {
  const name = `${source.replace(/[^\w.-]+/g, '-')}-${panel.id}`;
  const svg = () => {
    flush();
    return svgOf(panel, plot.current!, source);
  };
  const png = async () => {
    const {width, height, text} = svg();
    save(`${name}.png`, await pngOf(text, width, height));
  };
  return (
    <span class="exports">
      <button type="button" aria-label={`${panel.title} as SVG`}
        onClick={() => save(`${name}.svg`, new Blob([svg().text], {type: 'image/svg+xml'}))}>SVG</button>
      <button type="button" aria-label={`${panel.title} as PNG`} onClick={() => void png()}>PNG</button>
      <button type="button" aria-label={`${panel.title} as CSV`}
        onClick={() => save(`${name}.csv`, new Blob([panelCsv(panel)], {type: 'text/csv'}))}>CSV</button>
    </span>
  );
}
