# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Learns a task by proximal policy optimization (Schulman et al., 2017) with JAX and Optax.

    pip install -r requirements-learn.txt
    python ppo.py balance --frames 200000 --curve balance.csv --goal 450

TASK is a file of tenon_usd.tasks, or the name of one that the package has. Prints a row after each
improvement: frames, processor seconds, mean return of the episodes that ended since. Exit code 0:
the mean of the last ten rows reached --goal; 1: it did not.
"""

import argparse
import functools
import sys
import time

import jax
import jax.numpy as jnp
import numpy as np
import optax

from tenon_usd.tasks import TaskEnv

DISCOUNT, SMOOTHING, CLIP = 0.99, 0.95, 0.2
EPOCHS, PARTS = 8, 8
HIDDEN = 64


def layers(key, sizes, last):
    """Weights of a network; the last layer begins `last` times as large as the others."""
    made = []
    for i, (into, out) in enumerate(zip(sizes, sizes[1:])):
        key, one = jax.random.split(key)
        scale = last if i == len(sizes) - 2 else 1.0
        made.append((scale * jax.random.normal(one, (into, out)) / np.sqrt(into), jnp.zeros(out)))
    return made


def network(weights, x):
    for matrix, bias in weights[:-1]:
        x = jnp.tanh(x @ matrix + bias)
    matrix, bias = weights[-1]
    return x @ matrix + bias


def likelihood(parameters, observations, actions):
    """Logarithm of a normal distribution's density."""
    spread = parameters["spread"]
    off = (actions - network(parameters["actor"], observations)) / jnp.exp(spread)
    return (-0.5 * off**2 - spread - 0.5 * jnp.log(2 * jnp.pi)).sum(axis=-1)


@jax.jit
def act(parameters, observations, key):
    """Actions that are tried, their likelihood, and what the states are worth."""
    mean = network(parameters["actor"], observations)
    actions = mean + jnp.exp(parameters["spread"]) * jax.random.normal(key, mean.shape)
    return (actions, likelihood(parameters, observations, actions),
            network(parameters["critic"], observations)[:, 0])


@jax.jit
def worth(parameters, observations):
    return network(parameters["critic"], observations)[:, 0]


@functools.partial(jax.jit, static_argnames="optimizer")
def improve(parameters, state, batch, key, optimizer):
    """Some epochs over a batch: observations, actions, likelihoods, advantages, returns."""

    def loss(parameters, part):
        observations, actions, before, advantages, returns = part
        ratio = jnp.exp(likelihood(parameters, observations, actions) - before)
        gain = jnp.minimum(ratio * advantages, jnp.clip(ratio, 1 - CLIP, 1 + CLIP) * advantages)
        missed = (network(parameters["critic"], observations)[:, 0] - returns) ** 2
        return -gain.mean() + 0.5 * missed.mean()

    def one(carry, part):
        parameters, state = carry
        change, state = optimizer.update(jax.grad(loss)(parameters, part), state)
        return (optax.apply_updates(parameters, change), state), None

    def epoch(carry, key):
        order = jax.random.permutation(key, len(batch[0]))
        parts = [jnp.reshape(each[order], (PARTS, -1, *each.shape[1:])) for each in batch]
        return jax.lax.scan(one, carry, parts)

    carry, _ = jax.lax.scan(epoch, (parameters, state), jax.random.split(key, EPOCHS))
    return carry


class Scaled:
    """Observations by the mean and deviation of all that were seen."""

    def __init__(self, size):
        self.count, self.mean, self.square = 1e-4, np.zeros(size), np.ones(size) * 1e-4

    def see(self, rows):
        total = self.count + len(rows)
        off = rows.mean(axis=0) - self.mean
        self.square += ((rows - rows.mean(axis=0)) ** 2).sum(axis=0)
        self.square += off**2 * self.count * len(rows) / total
        self.mean += off * len(rows) / total
        self.count = total

    def __call__(self, rows):
        return np.clip((rows - self.mean) / np.sqrt(self.square / self.count + 1e-8), -10, 10)


class Runs:
    """Environments with the returns of their episodes."""

    def __init__(self, task, count, seed):
        self.envs = TaskEnv(task, num_envs=count, autoreset_mode="SameStep")
        self.observations, _ = self.envs.reset(seed=seed)
        self.scaled = Scaled(self.observations.shape[1])
        self.so_far, self.ended = np.zeros(count), []

    def collect(self, parameters, key, steps):
        """Steps of all environments as a batch, with advantages and returns."""
        rows = []
        for one in jax.random.split(key, steps):
            self.scaled.see(self.observations)
            seen = self.scaled(self.observations)
            actions, before, value = (np.asarray(each) for each in act(parameters, seen, one))
            self.observations, rewards, terminated, truncated, infos = self.envs.step(actions)
            self.so_far += rewards
            over = terminated | truncated
            self.ended += self.so_far[over].tolist()
            self.so_far[over] = 0
            following = np.array(worth(parameters, self.scaled(self.observations)))
            if truncated.any():
                last = np.asarray(worth(parameters, self.scaled(infos["final_obs"])))
                following = np.where(truncated, last, following)
            rows.append((seen, actions, before, value, rewards, following * ~terminated, over))
        seen, actions, before, value, rewards, following, over = map(np.stack, zip(*rows))
        advantages, ahead = np.zeros_like(value), np.zeros(value.shape[1])
        for i in reversed(range(steps)):
            ahead = (rewards[i] + DISCOUNT * following[i] - value[i]
                     + DISCOUNT * SMOOTHING * ahead * ~over[i])
            advantages[i] = ahead
        returns = advantages + value
        advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
        flat = [seen, actions, before, advantages, returns]
        return [jnp.asarray(each.reshape(-1, *each.shape[2:])) for each in flat]


def learn(task, frames, seed, count, steps, rate):
    """-> rows (frames, processor seconds, mean return of the episodes that ended since)."""
    runs = Runs(task, count, seed)
    size, actions = runs.observations.shape[1], runs.envs.single_action_space.shape[0]
    key, one, two = jax.random.split(jax.random.key(seed), 3)
    parameters = {"actor": layers(one, (size, HIDDEN, HIDDEN, actions), 0.01),
                  "critic": layers(two, (size, HIDDEN, HIDDEN, 1), 1.0),
                  "spread": jnp.full(actions, -0.5)}
    rounds = -(-frames // (count * steps))
    optimizer = optax.chain(optax.clip_by_global_norm(0.5), optax.adam(
        optax.linear_schedule(rate, 0.1 * rate, rounds * EPOCHS * PARTS)))
    state = optimizer.init(parameters)
    for i in range(rounds):
        key, one, two = jax.random.split(key, 3)
        batch = runs.collect(parameters, one, steps)
        parameters, state = improve(parameters, state, batch, two, optimizer)
        if runs.ended:
            yield (i + 1) * count * steps, time.process_time(), float(np.mean(runs.ended))
        runs.ended = []


def main():
    add = (parser := argparse.ArgumentParser(description=__doc__.partition("\n")[0])).add_argument
    add("task")
    add("--frames", type=int, default=200_000)
    add("--seed", type=int, default=0)
    add("--envs", type=int, default=32)
    add("--steps", type=int, default=64, help="of each environment between improvements")
    add("--rate", type=float, default=1e-3, help="of learning, at the start")
    add("--curve", help="a .csv to write the rows to")
    add("--goal", type=float, default=-np.inf)
    given = parser.parse_args()
    rows = []
    for row in learn(given.task, given.frames, given.seed, given.envs, given.steps, given.rate):
        rows.append("%d,%.1f,%.2f" % row)
        print(rows[-1], flush=True)
    if given.curve:
        with open(given.curve, "w", encoding="utf-8") as file:
            file.write("\n".join(["frames,processor_seconds,mean_return", *rows, ""]))
    means = [float(row.rpartition(",")[2]) for row in rows[-10:]]
    mean = float(np.mean(means or [-np.inf]))
    print(f"mean return of the last rows: {mean:.1f}")
    return 0 if mean >= given.goal else 1


if __name__ == "__main__":
    sys.exit(main())
