// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A baked motion: played, paused, and set to a time.
import * as THREE from "three";

export class Motion {
  readonly duration: number;
  playing = false;
  /** Seconds of the motion for one second. */
  speed = 1;
  time = 0;

  private readonly mixer: THREE.AnimationMixer;
  private last: number | null = null;
  private shown = -1;

  constructor(root: THREE.Object3D, clip: THREE.AnimationClip) {
    this.mixer = new THREE.AnimationMixer(root);
    const action = this.mixer.clipAction(clip);
    action.setLoop(THREE.LoopOnce, 1);
    action.clampWhenFinished = true;
    action.play();
    this.duration = clip.duration;
  }

  /** Goes on by the clock; whether something has moved. It begins anew behind its end. */
  advance(clock: number): boolean {
    const passed = this.last === null ? 0 : clock - this.last;
    this.last = clock;
    if (this.playing) {
      this.time = (this.time + passed * this.speed) % (this.duration || 1);
    }
    return this.apply();
  }

  seek(time: number): void {
    this.time = Math.min(Math.max(time, 0), this.duration);
  }

  /** Places everything where it is at `time`; whether that is another one than before. */
  apply(): boolean {
    if (this.time === this.shown) {
      return false;
    }
    this.shown = this.time;
    this.mixer.setTime(this.time);
    return true;
  }
}
