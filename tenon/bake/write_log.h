// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/bake/state_recording.h"
#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::bake {

/// One row per frame: time [s], then per body position, orientation (w, x, y, z), linear and
/// angular velocity, then per joint its coordinates and their velocities; stage units and degrees.
/// Columns are named PATH.position.x and so on. Outputs follow, except contacts.
std::string csv_log(const scene::PhysicsScene& scene, const StateRecording& recording);

/// One JSON object per line: {"time", "bodies": {PATH: {...}}, "joints": {PATH: {...}}}, named as
/// in the end state of `sim --json`; outputs are in their objects, "energy" and "work" beside
/// "bodies", "contacts" as a list.
std::string jsonl_log(const scene::PhysicsScene& scene, const StateRecording& recording);

/// A NumPy archive: time (frame_count), body_paths, position (frame_count x body_count x 3),
/// orientation (.. x 4), linear_velocity, angular_velocity (.. x 3), joint_paths, joint_offsets
/// (joint_count + 1) into the second axis of joint_position and joint_velocity (frame_count x
/// coordinate_count). Outputs are arrays of their own: vectors (.. x 3), of others NAME_offsets
/// says which numbers each object has; contact_offsets (frame_count + 1) into contact_colliders
/// (two indices into collider_paths), contact_point and so on.
Result<std::string> npz_log(const scene::PhysicsScene& scene, const StateRecording& recording);

/// One row per contact: time [s], colliders, bodies (empty: static), point, normal, depth (stage
/// units), force of the normal, of friction [N] and torque of friction [N m] on collider 1.
std::string contacts_csv(const scene::PhysicsScene& scene, const StateRecording& recording);

/// Where the contacts go of a log that is a table: "run.csv" -> "run.contacts.csv".
std::string contacts_path(const std::string& log);

/// The log for a file name ending in .csv, .jsonl or .npz; ErrorCode::Invalid for others.
Result<std::string> log_for(const std::string& path, const scene::PhysicsScene& scene,
                            const StateRecording& recording);

}  // namespace tenon::bake
