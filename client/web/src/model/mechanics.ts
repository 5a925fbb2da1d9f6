// A scenario with what follows from it: places, contacts one by one, stiffnesses.

import {
  Contact_Damping, Solver_Tension, Wall_Side, type Contact, type Material, type Scenario,
} from '../api/generated/contact/v1/scenario_pb';

export interface BodyModel {
  name: string;
  radius: number;
  position: number;
  fixed: boolean;
}

/** A contact between two bodies, or a body and a wall; -1 stands for the wall. */
export interface ContactModel {
  name: string;
  left: number;
  right: number;
  wallPosition: number;
  /** The name by which results tell where a wall is that moves, and from where its motion counts. */
  wallBody: string;
  wallOrigin: number;
  stiffness: number;
  exponent: number;
  damping: Contact_Damping;
  restitution: number;
}

export interface Mechanics {
  scenario: Scenario;
  bodies: BodyModel[];
  contacts: ContactModel[];
  clipTension: boolean;
  /** Which of its contacts or bodies are here, where there are too many: from which place on, and every n-th. */
  first?: number;
  every?: number;
}

function compliance(material: Material | undefined): number {
  return material ? (1 - (material.poissonRatio ?? NaN) ** 2) / material.youngsModulusPa : NaN;
}

/** Hertz: 4/3 E* √R*. */
function hertz(sides: {material: Material | undefined; curvature: number}[]): number {
  const modulus = 1 / sides.reduce((sum, side) => sum + compliance(side.material), 0);
  const radius = 1 / sides.reduce((sum, side) => sum + side.curvature, 0);
  return (4 / 3) * modulus * Math.sqrt(radius);
}

function bodiesOf(scenario: Scenario): BodyModel[] {
  const before = new Map<string, BodyModel>();
  return scenario.bodies.map((body) => {
    const radius = body.radiusM ?? 0;
    const beside = before.get(body.nextTo);
    const made = {
      name: body.name,
      radius,
      position: beside ? beside.position + beside.radius + radius + body.gapM : body.positionM,
      fixed: body.fixed || body.motion !== undefined,
    };
    before.set(body.name, made);
    return made;
  });
}

/** Where a wall's face is when nothing moves: of a play, where the body's edge meets it. */
function wallFace({wall, clearanceM}: Contact, left: boolean, radius: number): number {
  if (!wall) return NaN;
  return wall.positionM + (clearanceM === undefined ? 0 : (left ? -1 : 1) * (clearanceM + radius));
}

/** The contacts that an entry makes: of a play the left one has its bodies in the other order. */
function pairsOf({between, name, clearanceM}: Contact): {pair: (string | undefined)[]; name: string}[] {
  const whole = name || `${between[0]}-${between[1] ?? 'wall'}`;
  if (clearanceM !== undefined) {
    return [
      {pair: [between[1], between[0]], name: `${whole}-left`},
      {pair: [between[0], between[1]], name: `${whole}-right`},
    ];
  }
  if (between.length <= 2) return [{pair: between, name: whole}];
  return between.slice(1).map((right, i) => ({
    pair: [between[i]!, right],
    name: name ? `${name}-${i + 1}` : `${between[i]}-${right}`,
  }));
}

function contactsOf(scenario: Scenario, bodies: BodyModel[]): ContactModel[] {
  const index = new Map(bodies.map(({name}, i) => [name, i]));
  const side = (at: number) => ({
    material: scenario.bodies[at]?.material, curvature: 1 / (bodies[at]?.radius ?? 0),
  });
  return scenario.contacts.flatMap((contact) =>
    pairsOf(contact).map(({pair, name}) => {
      const at = (body: string | undefined) => (body === undefined ? -1 : index.get(body) ?? -1);
      const first = at(pair[0]), second = at(pair[1]);
      const wallLeft = contact.wall?.side === Wall_Side.LEFT && contact.clearanceM === undefined;
      const other = second >= 0 ? side(second) : {material: contact.wall?.material, curvature: 0};
      return {
        name,
        left: contact.wall && wallLeft ? -1 : first,
        right: contact.wall && wallLeft ? first : second,
        wallPosition: wallFace(contact, first < 0, bodies[Math.max(first, second)]?.radius ?? 0),
        wallBody: contact.wall?.motion ? name.replace(contact.clearanceM === undefined ? '' : /-(left|right)$/, '') : '',
        wallOrigin: contact.wall?.positionM ?? NaN,
        stiffness: contact.stiffness ?? (tabled(contact) ? lineOf(contact) : hertz([side(first), other])),
        exponent: contact.exponent ?? (tabled(contact) ? 1 : 1.5),
        damping: contact.damping,
        restitution: contact.restitution ?? NaN,
      };
    }));
}

/** Whether the force of a contact is a table, which depends on what it has borne. */
export const tabled = ({damping}: {damping: Contact_Damping}): boolean => damping === Contact_Damping.FORCE_TABLE;

/** The slope of the straight line to the last point of a table. */
const lineOf = ({forceTable}: Contact) => (forceTable?.forcesN.at(-1) ?? NaN) / (forceTable?.deformationsM.at(-1) ?? NaN);

/** Resolves what a scenario leaves to defaults. */
export function mechanicsOf(scenario: Scenario): Mechanics {
  const bodies = bodiesOf(scenario);
  return {
    scenario, bodies,
    contacts: contactsOf(scenario, bodies),
    clipTension: scenario.solver?.tension === Solver_Tension.CLIP,
  };
}

/** Laws whose damper does not fade with δ. */
const DASHPOTS = [Contact_Damping.KELVIN_VOIGT, Contact_Damping.DASHPOT];

/** The power of the unit of μ as a fraction. */
function fraction(value: number): string {
  let [over, under] = [Math.round(value), 1];
  for (let d = 2; d <= 100; ++d) if (Math.abs(value - Math.round(value * d) / d) < Math.abs(value - over / under) - 1e-12) [over, under] = [Math.round(value * d), d];
  return under === 1 ? `${over}` : `${over}/${under}`;
}

/** The power of δ in the damper of a contact. */
function dampingExponent({damping, exponent}: ContactModel): number {
  return DASHPOTS.includes(damping) ? 0 : damping === Contact_Damping.HERTZ_QUARTER_POWER ? 0.25 : exponent;
}

/** The unit of μ in μ δⁿ δ̇, if all these contacts have the same n: N·s/m^(5/2) of n = 3/2. */
export function muUnit(contacts: ContactModel[]): string {
  const powers = new Set(contacts.map((contact) => fraction(dampingExponent(contact) + 1)));
  const power = powers.size === 1 ? [...powers][0]! : 'n+1';
  return `N·s/m${power === '1' ? '' : /^\d+$/.test(power) ? `^${power}` : `^(${power})`}`;
}

/** The force of a contact where δ̇ or δ is 0, as at the ends of a cycle. */
export function endForce(
  {clipTension}: Mechanics, contact: ContactModel, mu: number, deformation: number, rate: number,
): number {
  const damper = DASHPOTS.includes(contact.damping) ? mu * rate : 0;
  const force = contact.stiffness * Math.max(deformation, 0) ** contact.exponent + damper;
  return clipTension ? Math.max(force, 0) : force;
}
