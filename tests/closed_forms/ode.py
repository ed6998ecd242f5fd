# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Motions without a closed form: Runge and Kutta of fourth order with steps of 0.1 ms, whose error
is below 1e-9 of the motion; and the oscillator, which has one."""

import cmath
import functools
import math

STEP = 1e-4


def integrate(rates, state, seconds, step=STEP):
    """`rates` takes a tuple and gives one. -> the state at the end"""
    count = max(1, round(seconds / step))
    h = seconds / count
    for _ in range(count):
        a = rates(state)
        b = rates([y + h / 2 * k for y, k in zip(state, a)])
        c = rates([y + h / 2 * k for y, k in zip(state, b)])
        d = rates([y + h * k for y, k in zip(state, c)])
        state = [y + h / 6 * (p + 2 * q + 2 * r + s) for y, p, q, r, s in zip(state, a, b, c, d)]
    return state


def oscillator(time, mass, damping, stiffness, start=0.0, target=0.0, velocity=0.0):
    """-> place, velocity of mass x'' + damping x' + stiffness (x - target) = 0."""
    half = damping / (2 * mass)
    root = cmath.sqrt(half * half - stiffness / mass)
    away = start - target
    if abs(root) < 1e-9:
        grow = velocity + half * away
        fade = math.exp(-half * time)
        return target + (away + grow * time) * fade, (velocity - half * grow * time) * fade
    first, second = -half + root, -half - root
    b = (velocity - first * away) / (second - first)
    a = away - b
    one, two = a * cmath.exp(first * time), b * cmath.exp(second * time)
    return target + (one + two).real, (first * one + second * two).real


@functools.lru_cache(maxsize=None)
def pendulum(time, start, strength, damping=0.0, velocity=0.0):
    """Angle and its rate [rad] of a'' = -strength sin a - damping a'."""
    return tuple(
        integrate(
            lambda y: (y[1], -strength * math.sin(y[0]) - damping * y[1]), [start, velocity], time
        )
    )


@functools.lru_cache(maxsize=None)
def tumble(time, moments, spin):
    """-> orientation (w, x, y, z) and angular velocity along the body's axes [rad/s] of a free body
    whose axes are at first those of the world."""
    one, two, three = moments

    def rates(y):
        w, x, z, v, p, q, r = y
        return (
            (-x * p - z * q - v * r) / 2,
            (w * p + z * r - v * q) / 2,
            (w * q + v * p - x * r) / 2,
            (w * r + x * q - z * p) / 2,
            (two - three) * q * r / one,
            (three - one) * r * p / two,
            (one - two) * p * q / three,
        )

    end = integrate(rates, [1.0, 0.0, 0.0, 0.0, *spin], time)
    return tuple(end[:4]), tuple(end[4:])


@functools.lru_cache(maxsize=None)
def double_pendulum(time, angles, masses, lengths, inertias, gravity):
    """Angles from straight down of two rods whose centres of mass are in their middles, from rest;
    `lengths` whole ones, `inertias` about the centres. -> angles, rates"""
    m, n = masses
    a, b = lengths
    first = inertias[0] + m * a * a / 4 + n * a * a
    second = inertias[1] + n * b * b / 4
    couple = n * a * b / 2

    def rates(y):
        p, q, u, v = y
        cos, sin = math.cos(p - q), math.sin(p - q)
        r = -couple * sin * v * v - (m / 2 + n) * gravity * a * math.sin(p)
        s = couple * sin * u * u - n * gravity * b / 2 * math.sin(q)
        mixed = couple * cos
        det = first * second - mixed * mixed
        return u, v, (second * r - mixed * s) / det, (first * s - mixed * r) / det

    return tuple(integrate(rates, [*angles, 0.0, 0.0], time))


@functools.lru_cache(maxsize=None)
def cart(time, angle, cart_mass, mass, arm, inertia, gravity):
    """A carriage on a rail without friction and a pendulum on it, from rest.
    -> way of the carriage, angle from straight down, their rates"""
    turning = inertia + mass * arm * arm
    whole = cart_mass + mass

    def rates(y):
        _, p, u, v = y
        mixed = mass * arm * math.cos(p)
        push = mass * arm * math.sin(p) * v * v
        pull = -mass * gravity * arm * math.sin(p)
        det = whole * turning - mixed * mixed
        return u, v, (turning * push - mixed * pull) / det, (whole * pull - mixed * push) / det

    return tuple(integrate(rates, [0.0, angle, 0.0, 0.0], time))
