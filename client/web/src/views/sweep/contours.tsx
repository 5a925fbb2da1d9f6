// Lines of equal value over the cells of a map.

import type {Contour, ContourLabel} from '../../model/contour_shapes';

/** White on both sides of each line and around each label, so that they are seen on every colour. */
export function Contours({contours, labels}: {contours: Contour[]; labels: ContourLabel[]}) {
  return (
    <g data-contours={contours.length} fill="none" stroke-linejoin="round">
      {contours.map(({level, path}) => <path key={`rim ${level}`} d={path} stroke="#fff" stroke-width="3" />)}
      {contours.map(({level, path}) => <path key={level} data-level={level} d={path} stroke="#000" stroke-width="1.2" />)}
      {labels.map(({x, y, text}) => <text key={`${x},${y}`} x={x} y={y + 4} text-anchor="middle" fill="#000" class="halo bright">{text}</text>)}
    </g>
  );
}
