// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The WebSocket to the session (docs/viewer.md). Requests are promises; notices and frames are
// events. A connection that breaks is made again, a little later each time.
import type { Finding, Notices, Requests } from "./protocol";

export type RequestName = keyof Requests;
export type Fields<Name extends RequestName> = Requests[Name]["fields"];
export type Answer<Name extends RequestName> = Requests[Name]["answer"];
/** Requests that may come without fields. */
export type BareRequest = { [Name in RequestName]: {} extends Fields<Name> ? Name : never }[RequestName];

/** What can be heard: notices, frames, which requests are sent, and how the connection is. */
interface Heard extends Notices {
  frame: Float32Array;
  asking: RequestName;
  open: null;
  closed: null;
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
  ask<Name extends BareRequest>(name: Name): Promise<Answer<Name>>;
  ask<Name extends RequestName>(name: Name, fields: Fields<Name>): Promise<Answer<Name>>;
  ask(name: RequestName, fields: object = {}): Promise<unknown> {
    return new Promise((resolve, reject) => {
      if (this.socket?.readyState !== WebSocket.OPEN) {
        reject(new Error("tenon view is not there; it is tried again"));
        return;
      }
      const id = ++this.number;
      this.tell("asking", name);
      this.waiting.set(id, { resolve, reject });
      this.socket.send(JSON.stringify({ do: name, id, ...fields }));
    });
  }

  /** Hears notices of one name. */
  on<Name extends keyof Heard>(name: Name, hear: (notice: Heard[Name]) => void): void {
    this.addEventListener(name, (event) => hear((event as CustomEvent<Heard[Name]>).detail));
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

  private tell<Name extends keyof Heard>(name: Name, detail: Heard[Name]): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  private hear(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      this.tell("frame", new Float32Array(data));
      return;
    }
    const notice = JSON.parse(data) as Notices[keyof Notices];
    if (notice.is !== "answer" && notice.is !== "error") {
      this.tell(notice.is, notice);
      return;
    }
    const id = notice.id as number;
    const waiting = this.waiting.get(id);
    this.waiting.delete(id);
    notice.is === "answer" ? waiting?.resolve(notice.result) : waiting?.reject(new Refusal(notice.error));
  }
}
