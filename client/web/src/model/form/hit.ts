// What of a drawn scenario is at a place.

import type {ContactModel, Mechanics} from '../mechanics';

/** What is drawn at x = toX(position in m), in px. */
export interface Drawn {
  mechanics: Mechanics;
  scale: number;
  toX: (x: number) => number;
}

const LEAST_PX = 4;     // Radius of a body as it is drawn.
const CONTACT_PX = 6;   // Half of what a contact takes of bodies that touch.

/** The middle of the gap of a contact and half its width, in px. */
function gapOf({mechanics: {bodies}, toX}: Drawn, {left, right, wallPosition}: ContactModel): {at: number; half: number} {
  const [a, b] = [bodies[left], bodies[right]];
  const ends = [a ? a.position + a.radius : wallPosition, b ? b.position - b.radius : wallPosition].map(toX) as [number, number];
  return {at: (ends[0] + ends[1]) / 2, half: Math.abs(ends[1] - ends[0]) / 2};
}

/** The body or contact nearest to a place of the drawing: where bodies touch, their contact. Undefined if there is none. */
export function hitAt(drawn: Drawn, x: number): {list: 'bodies' | 'contacts'; name: string} | undefined {
  const {mechanics: {bodies, contacts}, scale, toX} = drawn;
  const of = (list: 'bodies' | 'contacts', name: string, far: number) => ({list, name, far});
  const all = [
    ...contacts.map((contact) => {
      const {at, half} = gapOf(drawn, contact);
      const edge = Math.max(half, Math.min(CONTACT_PX, ...[contact.left, contact.right].map((i) => (bodies[i] ? Math.max(bodies[i]!.radius * scale, LEAST_PX) / 2 : CONTACT_PX))));
      return of('contacts', contact.name, Math.abs(x - at) - edge);
    }),
    ...bodies.map(({name, position, radius}) => of('bodies', name, Math.abs(x - toX(position)) - Math.max(radius * scale, LEAST_PX))),
  ].filter(({far}) => Number.isFinite(far));
  const inside = all.find(({far}) => far <= 0);   // Contacts come first.
  return inside ?? all.sort((a, b) => a.far - b.far)[0];
}
