# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A log of a robot as Drake simulates it, with what drives of real robots do.

    drake_log.py URDF MOTION NUMBERS LOG

MOTION is a table of `tenon excite`: times and, of each joint, where its drive is to be and how
fast. NUMBERS is JSON: "joints" with, of each joint by its name, stiffness [N m/rad], driveDamping
[N m s/rad], friction [N m], damping [N m s/rad], armature [kg m^2] and start [rad]; "delay" [s];
and of what no asset states, each 0 where it is not there: "stribeck", the part by which friction is
larger at rest than while the joint turns, which wears off over "stribeckSpeed" [rad/s]; "ripple"
[N m], of each motor, six times a turn; "load", the part of the drive's effort that bearings add to
friction. LOG is a CSV of positions of 16 bit and of efforts
with 1 % of noise, at the times of the motion.
"""

import csv
import json
import logging
import sys

import numpy as np
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import RevoluteJoint
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import DiagramBuilder, LeafSystem

STEP = 1e-4
#: Speed below which friction builds up [rad/s].
BUILDS_UP = 0.002
COUNT = 2 * np.pi / 2 ** 16
#: How long the robot comes to rest before the log begins [s].
RESTS = 2.0


class Drives(LeafSystem):
    """Efforts of motors and friction, of the state of the plant and of commands that hold."""

    def __init__(self, numbers, names, actuated):
        super().__init__()
        own = [numbers["joints"][name] for name in names]
        for family in ("stiffness", "driveDamping", "friction"):
            setattr(self, family, np.array([each[family] for each in own], dtype=float))
        self.stribeck, self.decay, self.ripple, self.load = (
            numbers[name] for name in ("stribeck", "stribeckSpeed", "ripple", "load"))
        self.count, self.actuated = len(names), [names.index(name) for name in actuated]
        self.aim = np.array([float(each["start"]) for each in own])
        self.aim_speed = np.zeros(len(own))
        self.state = self.DeclareVectorInputPort("state", 2 * self.count)
        self.DeclareVectorOutputPort("effort", self.count, self._efforts)

    def drive(self, place, speed):
        return self.stiffness * (self.aim - place) + self.driveDamping * (self.aim_speed - speed)

    def _efforts(self, context, output):
        state = self.state.Eval(context)
        place, speed = state[:self.count], state[self.count:]
        drive = self.drive(place, speed)
        rest = 1 + self.stribeck * np.exp(-(speed / self.decay) ** 2)
        friction = (self.friction * rest + self.load * np.abs(drive)) * np.tanh(speed / BUILDS_UP)
        whole = drive - friction + self.ripple * np.sin(6 * place)
        output.SetFromVector(whole[self.actuated])


def simulated(urdf, numbers, times, commands, names):
    """Positions, and efforts of drives, at the times: (samples, joints) each."""
    builder = DiagramBuilder()
    plant = builder.AddSystem(MultibodyPlant(0.0))
    parser = Parser(plant)
    parser.SetAutoRenaming(True)
    model, = parser.AddModels(urdf)
    driven = {plant.get_joint_actuator(index).joint().name()
              for index in plant.GetJointActuatorIndices()}
    world = plant.world_body()
    if not any(plant.get_joint(index).parent_body() is world
               for index in plant.GetJointIndices(model)):
        base = plant.get_body(plant.GetBodyIndices(model)[0])
        plant.WeldFrames(plant.world_frame(), base.body_frame())
    for index in plant.GetJointIndices(model):
        joint = plant.get_joint(index)
        if not isinstance(joint, RevoluteJoint):
            continue
        of = numbers["joints"][joint.name()]
        joint.set_default_damping(of["damping"])
        joint.set_default_angle(of["start"])
        if joint.name() not in driven:
            plant.AddJointActuator(joint.name(), joint)
    for index in plant.GetJointActuatorIndices():
        actuator = plant.get_joint_actuator(index)
        actuator.set_default_gear_ratio(1.0)
        actuator.set_default_rotor_inertia(numbers["joints"][actuator.joint().name()]["armature"])
    plant.Finalize()
    order = [""] * plant.num_velocities()
    for index in plant.GetJointIndices(model):
        joint = plant.get_joint(index)
        if joint.num_velocities() == 1:
            order[joint.velocity_start()] = joint.name()
    assert plant.num_positions() == plant.num_velocities() == plant.num_actuators()
    actuated = [plant.get_joint_actuator(index).joint().name()
                for index in plant.GetJointActuatorIndices()]
    drives = builder.AddSystem(Drives(numbers, order, actuated))
    builder.Connect(plant.get_state_output_port(), drives.get_input_port())
    builder.Connect(drives.get_output_port(), plant.get_actuation_input_port())
    diagram = builder.Build()
    simulator = Simulator(diagram)
    ApplySimulatorConfig(SimulatorConfig(integration_scheme="runge_kutta3", max_step_size=STEP,
                                         use_error_control=False), simulator)
    simulator.Initialize()
    mine = plant.GetMyContextFromRoot(simulator.get_context())
    at = [order.index(name) for name in names]
    # Commands hold until the next one, which comes late; what is logged is of just before.
    moments = sorted([(time, 1, row) for row, time in enumerate(times)]
                     + [(time + numbers["delay"], 2, row) for row, time in enumerate(times)])
    place, effort = (np.zeros((len(times), len(names))) for _ in range(2))
    for time, what, row in moments:
        if time > times[-1]:
            break
        simulator.AdvanceTo(RESTS + time)
        if what == 2:
            drives.aim[at], drives.aim_speed[at] = commands[row, ::2], commands[row, 1::2]
        else:
            positions = plant.GetPositions(mine)
            place[row] = positions[at]
            effort[row] = drives.drive(positions, plant.GetVelocities(mine))[at]
    return place, effort


def main():
    urdf, motion, numbers, log = sys.argv[1:]
    logging.getLogger("drake").setLevel(logging.ERROR)  # it reads no friction
    with open(numbers, encoding="utf-8") as file:
        numbers = json.load(file)
    with open(motion, encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if not row[0].startswith("#")]
    table = np.array(rows[1:], dtype=float)
    names = [name.rpartition("/")[2].partition(".")[0] for name in rows[0][1::2]]
    place, effort = simulated(urdf, numbers, table[:, 0], np.radians(table[:, 1:]),
                              names)
    random = np.random.default_rng(1)
    place = np.round(place / COUNT) * COUNT
    effort += 0.01 * effort.std(axis=0) * random.standard_normal(effort.shape)
    with open(log, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["time", *(f"{name}.{signal}" for signal in ("position", "effort")
                                   for name in names)])
        writer.writerows(np.column_stack([table[:, 0], place, effort]).tolist())


if __name__ == "__main__":
    main()
