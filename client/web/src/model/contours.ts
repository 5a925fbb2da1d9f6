// Lines of equal value between the cells of a map.

/** A line by its points, in columns and rows from the middle of the first cell. */
export type ContourLine = [number, number][];

const WANTED = 6;         // Levels in equal steps.
const MOST_DECADES = 4;   // With 2 and 5 of each.
const NOISE = 1e-9;       // Of a value; a smaller range has no levels.

function roundNumbers(low: number, high: number): number[] {
  const decade = 10 ** Math.floor(Math.log10((high - low) / WANTED));
  const step = decade * ([1, 2, 5].find((part) => part * decade * WANTED >= high - low) ?? 10);
  const first = Math.ceil(low / step);
  return Array.from({length: WANTED + 1}, (_, i) => (first + i) * step).filter((level) => level <= high);
}

/**
 * Round numbers of a range: about six in equal steps, or 1, 2 and 5 of each decade if a logarithmic
 * scale has more than one; only 1 if it has more than four.
 */
export function contourLevels([low, high]: [number, number], log: boolean): number[] {
  if (!(high - low > NOISE * Math.max(Math.abs(low), Math.abs(high))) || (log && low <= 0)) return [];
  const decades = log ? Math.log10(high / low) : 0;
  if (decades < 1) return roundNumbers(low, high);
  const first = Math.floor(Math.log10(low));
  const parts = decades > MOST_DECADES ? [1] : [1, 2, 5];
  return Array.from({length: Math.ceil(decades) + 2}, (_, k) => parts.map((part) => Number(`${part}e${first + k}`))).flat()
    .filter((level) => level >= low && level <= high);
}

// An edge from a cell to the next one has twice the number of the cell, one to the row above has one more.
const edgesOf = (cell: number, columns: number) => [2 * cell, 2 * (cell + 1) + 1, 2 * (cell + columns), 2 * cell + 1] as const;

/** The pieces of lines between four cells, each from edge to edge. */
function pieces(values: number[], columns: number, level: number, cell: number): [number, number][] {
  const corners = [cell, cell + 1, cell + columns + 1, cell + columns].map((at) => values[at]!);
  if (!corners.every(Number.isFinite)) return [];
  const above = corners.map((value) => value >= level);
  const edges = edgesOf(cell, columns);
  const crossed = edges.filter((_, side) => above[side] !== above[(side + 1) % 4]);
  if (crossed.length < 4) return crossed.length === 2 ? [[crossed[0]!, crossed[1]!]] : [];
  const middle = corners.reduce((a, b) => a + b) / 4 >= level;   // Opposite corners meet where the middle is like them.
  const [below, right, top, left] = edges;
  return middle === above[0] ? [[below, right], [top, left]] : [[left, below], [right, top]];
}

/** Joins pieces to lines: first those that have ends, then the closed ones. */
function joined(parts: [number, number][]): number[][] {
  const ways = new Map<number, number[]>();
  const add = (from: number, to: number) => { ways.set(from, [...ways.get(from) ?? [], to]); };
  parts.forEach(([a, b]) => { add(a, b); add(b, a); });
  const walk = (from: number): number[] => {
    const line = [from];
    for (let at = from, to = ways.get(at)!.pop(); to !== undefined; to = ways.get(at)!.pop()) {
      const back = ways.get(to)!;
      back.splice(back.indexOf(at), 1);
      line.push(to);
      at = to;
    }
    return line;
  };
  const ends = [...ways].filter(([, to]) => to.length === 1).map(([from]) => from);
  return [...ends, ...ways.keys()].map(walk).filter((line) => line.length > 1);
}

/** The lines of a level in a grid, given row by row; none beside a value that is not finite. */
export function contourLines(values: number[], columns: number, level: number): ContourLine[] {
  const pointOf = (edge: number): [number, number] => {
    const from = Math.floor(edge / 2);
    const upwards = edge % 2 === 1;
    const to = values[from + (upwards ? columns : 1)]!;
    const part = (level - values[from]!) / (to - values[from]!);
    const [i, j] = [from % columns, Math.floor(from / columns)];
    return upwards ? [i, j + part] : [i + part, j];
  };
  const parts = values.slice(0, -columns).flatMap((_, cell) => ((cell + 1) % columns === 0 ? [] : pieces(values, columns, level, cell)));
  return joined(parts).map((line) => line.map(pointOf)).filter((line) => line.some(([x, y]) => x !== line[0]![0] || y !== line[0]![1]));
}
