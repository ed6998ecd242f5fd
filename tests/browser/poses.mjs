// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Rigid motions: {p: [x, y, z] in metres, q: [x, y, z, w]}, and where a joint holds its second body.
const rotated = ([x, y, z, w], v) => {
  const t = [
    2 * (y * v[2] - z * v[1]),
    2 * (z * v[0] - x * v[2]),
    2 * (x * v[1] - y * v[0]),
  ];
  return [
    v[0] + w * t[0] + y * t[2] - z * t[1],
    v[1] + w * t[1] + z * t[0] - x * t[2],
    v[2] + w * t[2] + x * t[1] - y * t[0],
  ];
};

export const product = (a, b) => ({
  p: rotated(a.q, b.p).map((x, i) => x + a.p[i]),
  q: [
    a.q[3] * b.q[0] + a.q[0] * b.q[3] + a.q[1] * b.q[2] - a.q[2] * b.q[1],
    a.q[3] * b.q[1] - a.q[0] * b.q[2] + a.q[1] * b.q[3] + a.q[2] * b.q[0],
    a.q[3] * b.q[2] + a.q[0] * b.q[1] - a.q[1] * b.q[0] + a.q[2] * b.q[3],
    a.q[3] * b.q[3] - a.q[0] * b.q[0] - a.q[1] * b.q[1] - a.q[2] * b.q[2],
  ],
});

export const inverse = ({ p, q }) => {
  const back = [-q[0], -q[1], -q[2], q[3]];
  return { p: rotated(back, p).map((x) => -x), q: back };
};

/** Metres, and radians, between two. */
export const apart = (a, b) => {
  const { q } = product(inverse(a), b);
  const turned = 2 * Math.asin(Math.min(1, Math.hypot(q[0], q[1], q[2])));
  return [Math.hypot(...a.p.map((x, i) => x - b.p[i])), turned];
};

/** A frame of `tenon physics --json`, whose orientation begins with its real part. */
const frame = ({ position, orientation: [w, x, y, z] }) => ({ p: position, q: [x, y, z, w] });

/** Where the second body of a joint stands in the first one, at a position [rad, m]. */
export function held(joint, position) {
  const axis = ["X", "Y", "Z"].map((name) => (name === joint.axis ? 1 : 0));
  const moved =
    joint.type === "revolute"
      ? {
          p: [0, 0, 0],
          q: [...axis.map((x) => x * Math.sin(position / 2)), Math.cos(position / 2)],
        }
      : { p: axis.map((x) => x * position), q: [0, 0, 0, 1] };
  return product(product(frame(joint.frame0), moved), inverse(frame(joint.frame1)));
}
