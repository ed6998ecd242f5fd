// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// How finely pictures are drawn while something moves: where they come too slowly, as software
// graphics on a busy machine make them, with fewer pixels and without shadows, and with all of them
// when it stands still.

const slow = 1 / 14; // [s] from one picture to the next
const patience = 4; // slow pictures in a row
const rest = 0.4; // [s] after which it stands still

export class Pace {
  /** Share of the pixels along each side. */
  share = 1;
  private last = -1;
  private late = 0;

  /** At a picture that is due to motion; `clock` [s]. */
  drawn(clock: number): void {
    const apart = clock - this.last;
    this.last = clock;
    if (apart < rest) {
      this.late = apart > slow ? this.late + 1 : 0;
    }
    if (this.late >= patience) {
      this.share = 0.5;
    }
  }

  /** Whether a picture that lacks something is to be drawn again since nothing has moved for a while. */
  restsAt(clock: number, unfinished = false): boolean {
    return (this.share < 1 || unfinished) && clock - this.last > rest;
  }

  fine(): void {
    this.share = 1;
    this.late = 0;
  }
}
