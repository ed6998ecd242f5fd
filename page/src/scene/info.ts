// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the scene of a GLB by tenon says beside its shapes: `extras.tenon`, which
// tenon/glb/scene_extras.cpp writes. Metres, kilograms, radians; poses are
// [x, y, z, qx, qy, qz, qw].

export type Pose = [number, number, number, number, number, number, number];

export interface BodyInfo {
  path: string;
  mass: number;
  centerOfMass: [number, number, number];
  principalAxes: [number, number, number, number];
  principalMoments: [number, number, number];
  inertiaBox: [number, number, number];
  kinematic: boolean;
  enabled: boolean;
  articulation: number | null;
}

export interface LimitInfo {
  dof: string;
  lower: number | null;
  upper: number | null;
}

export interface DriveInfo {
  dof: string;
  stiffness: number;
  damping: number;
  maxForce: number | null;
  targetPosition: number;
  targetVelocity: number;
}

export interface JointInfo {
  path: string;
  kind: string;
  body0: number | null;
  body1: number | null;
  frame0: Pose;
  frame1: Pose;
  axis: "X" | "Y" | "Z";
  limits: LimitInfo[];
  drives: DriveInfo[];
  articulation: number | null;
  enabled: boolean;
  closesLoop: boolean;
}

export interface ColliderInfo {
  path: string;
  body: number | null;
  kind: string;
  approximation: string;
  enabled: boolean;
  volume: number;
  sourceVolume: number | null;
  hullGap: number | null;
}

export interface ArticulationInfo {
  path: string;
  fixedBase: boolean;
  links: number[];
  joints: number[];
}

/** A camera with perspective. It looks along its -Z, +Y is up. */
export interface CameraInfo {
  path: string;
  /** That carries it; null: it stands still. */
  body: number | null;
  /** In the body's axes, or in the world's. */
  pose: Pose;
  /** Tangents of half the angles that it sees, sideways and upward. */
  halfWidth: number;
  halfHeight: number;
}

export interface NoteInfo {
  prim: string;
  what: string;
}

export interface SceneInfo {
  version: 1;
  up: [number, number, number];
  bodies: BodyInfo[];
  joints: JointInfo[];
  colliders: ColliderInfo[];
  articulations: ArticulationInfo[];
  cameras: CameraInfo[];
  /** Pairs of bodies that do not touch; -1 for what stands still. */
  filteredPairs: [number, number][];
  notes: NoteInfo[];
}

export const noScene: SceneInfo = {
  version: 1,
  up: [0, 1, 0],
  bodies: [],
  joints: [],
  colliders: [],
  articulations: [],
  cameras: [],
  filteredPairs: [],
  notes: [],
};

/** The kinds of nodes, as their extras name them. */
export type NodeKind = "world" | "body" | "visual" | "collider";
