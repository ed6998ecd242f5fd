// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the program tells the page of a recording, and the other way round: the JSON of
// tenon/asset/viewing/record_page.cpp.
import type { CameraInfo } from "../scene/info";

/** From an angle: degrees about the up axis from +X, and above the ground. */
export interface Orbit {
  azimuth: number;
  elevation: number;
  /** Larger is closer; 1 fits. */
  zoom: number;
  /** What is looked at: a path; "" is all. */
  target: string;
  /** How far it goes around in a film [degrees]. */
  turn: number;
}

export interface Settings {
  width: number;
  height: number;
  /** Names of layers of the panel that are to be seen, or not. */
  show: string[];
  hide: string[];
  /** "light", "dark", "transparent" or "#rrggbb". */
  background: string;
  /** A prim that is marked; "" is none. */
  select: string;
  orbit: Orbit | null;
  /** A camera of the asset. */
  camera: Omit<CameraInfo, "path"> | null;
}

export interface Film {
  container: "webm" | "mp4";
  codec: "avc" | "vp9" | "vp8" | "av1";
  /** Bits in a second. */
  bitrate: number;
  framesPerSecond: number;
}

/** What a call comes to: why it cannot be, or nothing. */
export type Outcome = { problem?: string; codecs?: string[]; duration?: number; size?: number };
