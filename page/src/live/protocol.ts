// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the page and the session say to each other. Made of the tables of the program (tenon/live)
// by tests/view/message_tables.py --write: change it there.

export interface PrimRow {
  path: string;
  specifier: string;
  type: string;
  active: boolean;
  instance: boolean;
}

export interface Property {
  name: string;
  type: string;
  /** as layers print it */ value: string | null;
  authored: boolean;
  /** what the value comes from */ source: string;
}

export interface Inspected {
  prim: string;
  type: string;
  apis: string[];
  /** authored ones first */ all: Property[];
}

export interface Opinion {
  /** null: the schema */ file: string | null;
  line: number | null;
  value: string | null;
  /** whether it counts */ verdict: string;
  why: string | null;
}

export interface Where {
  /** the strongest one first */ opinions: Opinion[];
}

export interface Finding {
  /** `error`, `warning` or `info` */ severity: string;
  /** `tenon explain RULE` tells of it */ rule: string | null;
  /** what is wrong */ message: string;
  file: string | null;
  line: number | null;
  prim: string | null;
  property: string | null;
  /** what to do */ fix: string | null;
  /** of a check: what the request `fix` writes */ autofix?: string | null;
  /** what it writes only when asked for */ suggestedFix?: string | null;
}

export interface EditedPlace {
  before: string | null;
  after: string | null;
  file: string;
  line: number | null;
  /** this file */ why: string;
}

export interface Difference {
  /** `added`, `removed` or `changed` */ change: string;
  path: string;
  /** null: the whole object */ what: string | null;
  unit: string | null;
  before: unknown;
  after: unknown;
}

export interface PhysicsEffect {
  variant: string | null;
  differences: Difference[];
}

export interface EditedFile {
  file: string;
  /** null: it is no text */ diff: string | null;
  keptLayout: boolean;
}

export interface Edited {
  dryRun: boolean;
  written: boolean;
  /** where it went */ edits: EditedPlace[];
  /** what engines receive otherwise */ physics: PhysicsEffect[];
  /** that change */ files: EditedFile[];
}

export interface PairFilter {
  why: string;
  property: string | null;
}

export interface FoundPair {
  bodyA: string;
  bodyB: string;
  adjacent: boolean;
  /** [m]; null: not at the start */ startDepth: number | null;
  /** of the postures */ share: number | null;
  /** `always`, `often`, `sometimes` or `never` */ class: string | null;
  /** [m] */ depth: number | null;
  /** `no`, `partly` or `yes` */ filtered: string;
  filters: PairFilter[];
  overFiltered: boolean;
}

export interface FoundPairs {
  postures: number;
  never: number;
  pairCount: number;
  pairs: FoundPair[];
}

export interface BodyPair {
  /** a body or static collider */ bodyA: string;
  /** the other one */ bodyB: string;
}

export interface DriveDemand {
  /** the joint's prim */ joint: string;
  dof: string;
  /** [N m, N] */ maxEffort: number | null;
  /** [rad/s, m/s] */ speedLimit: number | null;
  /** the largest that it has to hold [N m, N] */ weight: number | null;
  /** the least and the most [kg m^2, kg] */ inertia: (number | null)[];
  tooWeak: boolean;
  followers: string[];
}

export interface DriveLimits {
  /** the joint's prim */ joint: string;
  /** `transX` to `rotZ`: which of its drives */ dof: string;
  /** [N m, N]; default: as it is */ maxEffort?: number | null;
  /** [rad/s, m/s]; default: as it is */ speedLimit?: number | null;
}

export interface DriveGains {
  /** [N m/rad, N/m] */ stiffness: number;
  /** [N m s/rad, N s/m] */ damping: number;
  /** natural [rad/s] */ frequency: number | null;
  frequencyHz: number | null;
  dampingRatio: number | null;
  regime: string | null;
}

export interface TunedDrive {
  /** the joint's prim */ joint: string;
  axis: string;
  /** `force` or `acceleration`; null: there is no drive */ type: string | null;
  /** [N m/rad, N/m] */ stiffness: number;
  /** [N m s/rad, N s/m] */ damping: number;
  /** natural [rad/s] */ frequency: number | null;
  frequencyHz: number | null;
  dampingRatio: number | null;
  regime: string | null;
  /** it cannot be tuned */ whyNot: string | null;
  /** what was set */ to: DriveGains | null;
  notes: string[];
}

export interface LiveGains {
  /** [N m/rad, N/m] */ stiffness: number;
  /** [N m s/rad, N s/m] */ damping: number;
  /** natural [rad/s] */ frequency: number | null;
  frequencyHz: number | null;
  dampingRatio: number | null;
  regime: string | null;
  /** [rad/s]: what its steps hold; null: everything */ stableUpTo: number | null;
}

export interface TestSignal {
  /** [s] */ time: number[];
  /** [rad, m] */ command: number[];
  /** [rad, m] */ position: (number | null)[];
  /** [rad/s, m/s] */ velocity: (number | null)[];
  /** [N m, N] */ effort: (number | null)[];
}

export interface Tested {
  joint: string;
  axis: string;
  verdict: string;
  reasons: string[];
  /** the part of the time at its most effort */ saturation: number | null;
  /** of `snap` */ limits?: { target: number; settlingTime: number | null; maxHoldError: number | null; }[];
  /** of `step` */ step?: { overshoot: number | null; riseTime: number | null; settlingTime: number | null; };
  /** of `sine` */ sine?: { positionError: number | null; lag: number | null; gain: number | null; };
  /** of the notice `tested` */ signal?: TestSignal;
}

export interface TestedEngine {
  engine: string;
  results: Tested[];
}

export interface PoseJoint {
  joint: string;
  /** `missing` or `outside` its limits */ problem: string | null;
}

export interface NamedPose {
  name: string;
  path: string;
  valid: boolean;
  joints: PoseJoint[];
}

export interface Word {
  text: string;
}

export interface IdentifiedParameter {
  name: string;
  family: string;
  unit: string;
  /** of the asset */ nominal: number | null;
  /** identified */ value?: number | null;
  /** of 95 % */ low?: number | null;
  /** likewise */ high?: number | null;
  /** of the best fit */ expectedError?: number | null;
  /** whether the logs tell it */ told?: boolean;
  /** of a self-test */ truth?: number | null;
  /** likewise */ found?: number | null;
  /** standard error; of a self-test the part that it is off */ error?: number | null;
  /** of a self-test */ passed?: boolean;
}

export interface IdentifyCheck {
  parameters: IdentifiedParameter[];
  /** why the logs do not tell them */ refused: string[];
  quality: unknown;
}

export interface LeftOver {
  channel: string;
  joint: string;
  before: number | null;
  after: number | null;
}

export interface EngineReplay {
  engine: string;
  before: number | null;
  after: number | null;
  why: string;
}

export interface Identified {
  ok: boolean;
  check?: IdentifyCheck;
  parameters?: IdentifiedParameter[];
  /** root mean squares of residuals */ heldOut?: LeftOver[];
  engines?: EngineReplay[];
  /** of a self-test */ scores?: IdentifiedParameter[];
  /** why the layer would not be written */ problems?: string[];
}

export interface HelloNotice {
  /** of these messages */ protocol: number;
  /** of tenon */ version: string;
  /** number of this page */ client: number;
  /** the file that is shown */ asset: string;
  /** edits are refused */ readOnly: boolean;
  is: "hello";
}

export interface EngineChoice {
  name: string;
  available: boolean;
  howToGet: string | null;
}

export interface VariantChoice {
  prim: string;
  set: string;
  selection: string;
  options: string[];
}

export interface LiveDof {
  /** `transX` to `rotZ` */ dof: string;
  angular: boolean;
  /** [rad, m]; null: no limit */ lower: number | null;
  /** likewise */ upper: number | null;
}

export interface LiveDrive {
  dof: string;
  /** its target [rad, m] */ position: number;
  /** likewise [rad/s, m/s] */ velocity: number;
  /** [N m/rad, N/m] */ stiffness: number;
  /** [N m s/rad, N s/m] */ damping: number;
  /** [N m, N]; null: no limit */ maxForce: number | null;
}

export interface LiveJoint {
  path: string;
  kind: string;
  enabled: boolean;
  /** another joint */ follows: boolean;
  /** the first joint that it follows */ leader: string | null;
  dofs: LiveDof[];
  /** [rad, m] */ position: number[];
  drives: LiveDrive[];
}

export interface SceneNotice {
  /** of scene.glb: another number is another picture */ revision: number;
  /** `open`, `variant`, `engine`, `reset`, `edit`, `undo`, `redo` or `file` */ why: string;
  /** that simulates, or would */ engine: string;
  /** that there are */ engines: EngineChoice[];
  /** there is a model of the engine; else `problem` says why not */ simulates: boolean;
  /** why there is no model */ problem: Finding | null;
  /** what came up while the asset was opened, at most 50 */ opening: Finding[];
  /** [s] */ timeStep: number | null;
  /** that can be selected */ variants: VariantChoice[];
  /** in the order of pose frames */ bodies: string[];
  /** of the asset */ joints: LiveJoint[];
  /** there is an edit to take back */ canUndo: boolean;
  /** there is one to make again */ canRedo: boolean;
  is: "scene";
}

export interface EngineEvent {
  /** [s] */ time: number;
  prim: string;
  what: string;
}

export interface StateNotice {
  /** time goes on */ playing: boolean;
  /** [s] since the start */ time: number;
  /** simulated seconds for each second that is wanted */ speed: number;
  /** the rate that is reached */ rate: number;
  /** how many there are */ contacts: number;
  /** bodies being pulled */ pulled: number;
  /** what happened once since the start, the first 50 */ events: EngineEvent[];
  /** the step that failed; the last poses before it stay until a reset */ stopped: Finding | null;
  /** why changed files cannot be opened; what is shown is older than they are */ outdated: Finding | null;
  is: "state";
}

export interface PlotsNotice {
  /** [s] */ time: number;
  /** positions of each joint, in the order of `scene` [rad, m] */ joints: number[][];
  /** of each joint, likewise [rad/s, m/s] */ velocities: number[][];
  /** of each joint those of its drives [N m, N]; null where the engine does not tell */ efforts: (number[] | null)[];
  /** of each joint those of its drives: position and velocity in the same units */ targets: number[][][];
  /** of the first 256 bodies: linear velocity of the centre of mass [m/s], angular velocity [rad/s], world axes, as six numbers */ bodies: number[][];
  /** [J] */ kinetic: number;
  /** [J] */ potential: number;
  is: "plots";
}

export interface ContactRow {
  collider0: string;
  collider1: string;
  /** null: static */ body0: string | null;
  /** likewise */ body1: string | null;
  /** [m] */ point: [number, number, number];
  normal: [number, number, number];
  /** [m] */ depth: number;
  /** on collider1 [N] */ force: [number, number, number];
}

export interface ContactsNotice {
  /** [s] */ time: number;
  /** how many there are; `rows` has the first 1,000 */ count: number;
  /** world axes */ rows: ContactRow[];
  is: "contacts";
}

export interface ProgressNotice {
  /** the request */ of: string;
  /** is being done */ what: string;
  /** of all of it, from 0 to 1 */ done: number;
  is: "progress";
}

export interface TestedNotice {
  /** that ran the test */ engine: string;
  /** `snap`, `step` or `sine` */ test: string;
  /** with `signal`, at most 500 points of each */ result: Tested;
  is: "tested";
}

export interface AnswerNotice {
  /** the request's name */ to: string;
  /** the request's */ id: unknown;
  /** the result of the request */ result: object;
  is: "answer";
}

export interface ErrorNotice {
  /** the request's name, as far as it could be read */ to: string;
  /** the request's */ id: unknown;
  /** why not */ error: Finding;
  is: "error";
}

export interface ProblemNotice {
  /** why a changed file is not shown, why time stopped */ problem: Finding;
  is: "problem";
}

/** Requests: their fields and answers. */
export interface Requests {
  /** Lets time go on. */
  play: { fields: Record<string, never>; answer: Record<string, never> };
  /** Stops it. */
  pause: { fields: Record<string, never>; answer: Record<string, never> };
  /** Makes some time steps and stops. */
  step: { fields: { count?: number | null; }; answer: Record<string, never> };
  /** Back to the start; drive targets are the asset's again. */
  reset: { fields: Record<string, never>; answer: Record<string, never> };
  /** How fast time is to go on. */
  speed: { fields: { factor: number; }; answer: Record<string, never> };
  /** Sets a drive's target, until it is set again or reset. */
  setDrive: { fields: { joint: string; drive?: number | null; position?: number | null; velocity?: number | null; }; answer: { position: number; velocity: number; } };
  /** Moves a joint, and those that mimic it, by hand, while the simulation is paused. */
  setJoint: { fields: { joint: string; position: number[]; }; answer: { position: number[]; } };
  /** Forces or torques along a joint, on top of its drives, until they are set again or reset. */
  setEffort: { fields: { joint: string; effort: number[]; }; answer: { effort: number[]; } };
  /** A force on a body until it is set again or released; one pull for each page. */
  force: { fields: { body: string; point: [number, number, number]; force: [number, number, number]; }; answer: Record<string, never> };
  /** A spring between a point of a body and a point in the world, for pulling by mouse. */
  drag: { fields: { body: string; anchor: [number, number, number]; target: [number, number, number]; }; answer: Record<string, never> };
  /** Ends what this page pulls. */
  release: { fields: Record<string, never>; answer: Record<string, never> };
  /** Which notices this page gets while time goes on. */
  observe: { fields: { contacts?: boolean | null; plots?: boolean | null; }; answer: { contacts: boolean; plots: boolean; } };
  /** Selects a variant; no file is touched. */
  variant: { fields: { prim: string; set: string; variant: string; }; answer: Record<string, never> };
  /** Simulates on another engine, from the start. */
  engine: { fields: { engine: string; }; answer: Record<string, never> };
  /** All prims. */
  tree: { fields: Record<string, never>; answer: { prims: PrimRow[]; } };
  /** All that is known of a prim. */
  inspect: { fields: { prim: string; }; answer: Inspected };
  /** Which files have opinions on it, and which one counts. */
  where: { fields: { object: string; time?: number | null; }; answer: Where };
  /** Where a number comes from. */
  explain: { fields: { object: string; other?: string | null; }; answer: object };
  /** What is wrong with the asset. */
  findings: { fields: Record<string, never>; answer: { diagnostics: Finding[]; } };
  /** Changes a property in the file that owns it. */
  set: { fields: { object: string; value: string; engine?: string | null; }; answer: Edited };
  /** Removes the owning file's opinion. */
  clear: { fields: { object: string; }; answer: Edited };
  /** Takes the last edit back. */
  undo: { fields: Record<string, never>; answer: Record<string, never> };
  /** Makes it again. */
  redo: { fields: Record<string, never>; answer: Record<string, never> };
  /** Which bodies touch, in postures that are drawn. */
  pairs: { fields: { postures?: number | null; seed?: number | null; environment?: boolean | null; all?: boolean | null; }; answer: FoundPairs };
  /** Keeps pairs of bodies apart, or no longer. */
  filterPairs: { fields: { filter?: BodyPair[] | null; unfilter?: BodyPair[] | null; dryRun?: boolean | null; }; answer: Edited };
  /** What motors can do and have to hold. */
  drives: { fields: { postures?: number | null; seed?: number | null; }; answer: { postures: number; drives: DriveDemand[]; } };
  /** What motors can do, written to the files that own it. */
  setLimits: { fields: { limits: DriveLimits[]; dryRun?: boolean | null; }; answer: Edited };
  /** Gains as frequency and damping ratio; `to` has what was set. */
  gains: { fields: Record<string, never>; answer: { drives: TunedDrive[]; } };
  /** Sets gains in the model as it runs, until they are saved or forgotten. */
  setGains: { fields: { joint: string; dof: string; frequency?: number | null; dampingRatio?: number | null; stiffness?: number | null; damping?: number | null; }; answer: LiveGains };
  /** All gains are those of the files again. */
  forgetGains: { fields: Record<string, never>; answer: Record<string, never> };
  /** Writes what was set, as one edit. */
  saveGains: { fields: { dryRun?: boolean | null; }; answer: Edited };
  /** Tests drives one after the other with the gains that were set, beside what is shown. */
  testDrives: { fields: { test: string; joints?: string[] | null; period?: number | null; amplitude?: number | null; }; answer: { engines: TestedEngine[]; interrupted: boolean; } };
  /** Ends `pairs`, `drives` and `testDrives` that this page has asked for. */
  cancel: { fields: Record<string, never>; answer: Record<string, never> };
  /** The poses that the asset keeps. */
  poses: { fields: Record<string, never>; answer: { poses: NamedPose[]; file: string; } };
  /** Moves joints to a pose by hand; time has to stand still. */
  goToPose: { fields: { pose: string; hold?: boolean | null; }; answer: { joints: number; } };
  /** Keeps where the joints are now, over one of this name. */
  savePose: { fields: { name: string; dryRun?: boolean | null; }; answer: Edited };
  /** Gives a pose another name. */
  renamePose: { fields: { pose: string; name: string; dryRun?: boolean | null; }; answer: Edited };
  /** Removes a pose. */
  removePose: { fields: { pose: string; dryRun?: boolean | null; }; answer: Edited };
  /** Keeps all poses of a file, at most 32 KiB of text. */
  importPoses: { fields: { text: string; dryRun?: boolean | null; }; answer: Edited };
  /** Corrects findings that have a safe fix, as `tenon check --fix`. */
  fix: { fields: { rule?: string | null; prim?: string | null; property?: string | null; file?: string | null; line?: number | null; suggested?: boolean | null; dryRun?: boolean | null; }; answer: Edited };
  /** The logs that can be identified from. */
  identifyLogs: { fields: Record<string, never>; answer: { logs: string[]; commands: string | null; layer: string; whyNot: string | null; } };
  /** A stage of `tenon identify`; beside other long requests. */
  identify: { fields: { stage: string; logs?: Word[] | null; heldOut?: Word[] | null; parameters?: Word[] | null; priors?: Word[] | null; names?: Word[] | null; signs?: Word[] | null; units?: string | null; allowGaps?: boolean | null; hold?: boolean | null; training?: number | null; timeStep?: number | null; window?: number | null; starts?: number | null; }; answer: Identified };
  /** Writes what the last `solve` found as a layer over the asset. */
  writeIdentified: { fields: { force?: boolean | null; dryRun?: boolean | null; }; answer: Edited };
  /** These tables. */
  messages: { fields: Record<string, never>; answer: { protocol: number; requests: unknown[]; notices: unknown[]; } };
}

/** Notices, by name. */
export interface Notices {
  /** The first message to a page. */
  hello: HelloNotice;
  /** What there is to see and to steer; comes again when it changes. */
  scene: SceneNotice;
  /** Time, when it changes, four times a second while it goes on. */
  state: StateNotice;
  /** A point of the plots, twenty times a second for who observes. */
  plots: PlotsNotice;
  /** Where colliders touch, likewise. */
  contacts: ContactsNotice;
  /** How far a long request of this page is, ten times a second. */
  progress: ProgressNotice;
  /** What came of one drive, while `testDrives` goes on. */
  tested: TestedNotice;
  /** A request was done. */
  answer: AnswerNotice;
  /** A request was not done. */
  error: ErrorNotice;
  /** Something went wrong, not in a request. */
  problem: ProblemNotice;
}
