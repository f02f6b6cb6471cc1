import type { BodyHandle } from "./handles.js";

/** What a step did, summed over its substeps. */
export interface StepReport {
  /** Pairs of bodies whose boxes overlapped. */
  readonly pairs: number;
  /** Contacts that were separated. */
  readonly contacts: number;
  /** Sticks looked at. */
  readonly visits: number;
  /** Sticks that were off by more than the tolerance, and relaxed. */
  readonly relaxations: number;
  /** Bodies that are neither fixed nor asleep. */
  readonly awakeBodies: number;
  /** Bodies that turned non-finite and have been frozen, each with its first such particle. */
  readonly faults: readonly { readonly body: BodyHandle; readonly particle: number }[];
  /** Time by phase, and of the whole step, in ms. */
  readonly milliseconds: PhaseTimes;
}

/** Times in ms. */
export interface PhaseTimes {
  /** Moving particles. */
  readonly integrate: number;
  /** Finding pairs. */
  readonly broadPhase: number;
  /** Finding contacts. */
  readonly narrowPhase: number;
  /** Separating features. */
  readonly separate: number;
  /** Relaxing constraints. */
  readonly relax: number;
  /** Solving for rigid bodies. */
  readonly solve: number;
  /** Small steps of cloth and rope. */
  readonly soft: number;
  /** All of it. */
  readonly total: number;
}

/** The report of a world that has taken no step. */
export const NO_REPORT: StepReport = reportOf(new Float64Array(14), () => new Uint32Array());

/** Reads a row of the engine: six counts, eight times. */
export function reportOf(row: Float64Array, faultsOf: () => Uint32Array): StepReport {
  const at = (index: number): number => row[index] ?? 0;
  return {
    pairs: at(0),
    contacts: at(1),
    visits: at(2),
    relaxations: at(3),
    awakeBodies: at(4),
    faults: at(5) > 0 ? faults(faultsOf()) : [],
    milliseconds: {
      integrate: at(6),
      broadPhase: at(7),
      narrowPhase: at(8),
      separate: at(9),
      relax: at(10),
      solve: at(11),
      soft: at(12),
      total: at(13),
    },
  };
}

function faults(list: Uint32Array): StepReport["faults"] {
  const pairs: { body: BodyHandle; particle: number }[] = [];
  for (let i = 0; i + 1 < list.length; i += 2) {
    pairs.push({ body: list[i] as BodyHandle, particle: list[i + 1] as number });
  }
  return pairs;
}
