// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The WebSocket to the session (docs/viewer.md). Requests are promises; notices and frames are
// events. A connection that breaks is made again, a little later each time.

export interface Finding {
  severity: string;
  rule: string | null;
  message: string;
  file: string | null;
  line: number | null;
  prim: string | null;
  property: string | null;
  fix: string | null;
  /** Of findings of a check: what `fix` of the session writes, and what it writes only when asked. */
  autofix?: string | null;
  suggestedFix?: string | null;
}

export interface LiveDof {
  dof: string;
  angular: boolean;
  lower: number | null;
  upper: number | null;
}

export interface LiveDrive {
  dof: string;
  position: number;
  velocity: number;
  stiffness: number;
  damping: number;
  maxForce: number | null;
}

export interface LiveJoint {
  path: string;
  kind: string;
  enabled: boolean;
  follows: boolean;
  /** The joint that it follows. */
  leader: string | null;
  dofs: LiveDof[];
  position: number[];
  drives: LiveDrive[];
}

export interface SceneNotice {
  revision: number;
  why: string;
  engine: string;
  engines: { name: string; available: boolean; howToGet: string | null }[];
  simulates: boolean;
  problem: Finding | null;
  opening: Finding[];
  timeStep: number | null;
  variants: { prim: string; set: string; selection: string; options: string[] }[];
  bodies: string[];
  joints: LiveJoint[];
  canUndo: boolean;
  canRedo: boolean;
}

export interface StateNotice {
  playing: boolean;
  time: number;
  speed: number;
  rate: number;
  contacts: number;
  pulled: number;
  events: { time: number; prim: string; what: string }[];
  /** The step that failed; poses stay until a reset. */
  stopped: Finding | null;
  /** Why changed files cannot be opened: what is shown is older than they are. */
  outdated: Finding | null;
}

export interface PlotsNotice {
  time: number;
  joints: number[][];
  velocities: number[][];
  /** Of each joint those of its drives; null: the engine does not tell. */
  efforts: (number[] | null)[];
  /** Of each drive of each joint position and velocity. */
  targets: [number, number][][];
  /** Linear and angular velocity of the first bodies. */
  bodies: number[][];
  kinetic: number;
  potential: number;
}

export interface ContactRow {
  collider0: string;
  collider1: string;
  body0: string | null;
  body1: string | null;
  point: [number, number, number];
  normal: [number, number, number];
  depth: number;
  force: [number, number, number];
}

export interface ContactsNotice {
  time: number;
  count: number;
  rows: ContactRow[];
}

export interface HelloNotice {
  protocol: number;
  version: string;
  asset: string;
  readOnly: boolean;
}

/** What a request that was refused says. */
export class Refusal extends Error {
  constructor(readonly finding: Finding) {
    super(finding.fix ? `${finding.message}; ${finding.fix}` : finding.message);
  }
}

interface Waiting {
  resolve: (result: unknown) => void;
  reject: (fault: Error) => void;
}

const longestPause = 5000; // ms

export class Connection extends EventTarget {
  private socket: WebSocket | null = null;
  private readonly waiting = new Map<number, Waiting>();
  private number = 0;
  private pause = 250;

  /** `to` is the address of the WebSocket. */
  constructor(private readonly to: string) {
    super();
    this.connect();
  }

  /** The result of a request. Rejects with Refusal, or where the connection breaks. */
  ask<T = unknown>(name: string, fields: Record<string, unknown> = {}): Promise<T> {
    return new Promise<T>((resolve, reject) => {
      if (this.socket?.readyState !== WebSocket.OPEN) {
        reject(new Error("tenon view is not there; it is tried again"));
        return;
      }
      const id = ++this.number;
      this.tell("asking", name);
      this.waiting.set(id, { resolve: resolve as (result: unknown) => void, reject });
      this.socket.send(JSON.stringify({ do: name, id, ...fields }));
    });
  }

  /** Hears notices of one name. */
  on<T>(name: string, hear: (notice: T) => void): void {
    this.addEventListener(name, (event) => hear((event as CustomEvent<T>).detail));
  }

  private connect(): void {
    const socket = new WebSocket(this.to);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.pause = 250;
      this.tell("open", null);
    };
    socket.onmessage = (event) => this.hear(event.data as string | ArrayBuffer);
    socket.onclose = () => {
      this.socket = null;
      for (const one of this.waiting.values()) {
        one.reject(new Error("the connection broke"));
      }
      this.waiting.clear();
      this.tell("closed", null);
      setTimeout(() => this.connect(), this.pause);
      this.pause = Math.min(2 * this.pause, longestPause);
    };
    this.socket = socket;
  }

  private tell(name: string, detail: unknown): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  private hear(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      this.tell("frame", new Float32Array(data));
      return;
    }
    const notice = JSON.parse(data) as { is: string; id?: number; result?: unknown; error?: Finding };
    const waiting = this.waiting.get(notice.id ?? 0);
    this.waiting.delete(notice.id ?? 0);
    if (notice.is === "answer") {
      waiting?.resolve(notice.result);
    } else if (notice.is === "error") {
      waiting?.reject(new Refusal(notice.error!));
    } else {
      this.tell(notice.is, notice);
    }
  }
}
