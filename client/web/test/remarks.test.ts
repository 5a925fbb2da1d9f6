import {describe, expect, it} from 'vitest';

import {labelChangeOf, labelsText, noteHint, relabelled} from '../src/model/remarks';

describe('labels as they are typed', () => {
  it('are given by key=value and taken away by key-', () => {
    const change = labelChangeOf('law=flores, trial-  n=a=b old');
    expect(change).toEqual({set: {law: 'flores', n: 'a=b'}, removed: ['trial'], wrong: ['old']});
    expect(relabelled({labels: {trial: '1', law: 'x', keep: ''}}, change)).toEqual({law: 'flores', keep: '', n: 'a=b'});
  });
  it('are typed as they are shown', () => {
    const labels = {b: '', a: 'x-', 'c-': 'y='};
    expect(labelsText(labels)).toBe('a=x-, b=, c-=y=');
    expect(labelChangeOf(labelsText(labels))).toEqual({set: labels, removed: [], wrong: []});
  });
});

describe('the hint of a note', () => {
  it('is its first line, cut where it is long', () => {
    expect(noteHint('good')).toBe('good');
    expect(noteHint('good\nbut slow')).toBe('good …');
    expect(noteHint('εεεε', 3)).toBe('εεε …');
    expect(noteHint('\n good \n')).toBe('good');
  });
});
