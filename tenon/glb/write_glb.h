// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/bake/pose_recording.h"
#include "tenon/base/result.h"
#include "tenon/view/view_scene.h"

/// Views as binary glTF 2.0, which browsers and most 3D programs read.
namespace tenon::glb {

struct GlbOptions {
  /// A motion of the bodies of the view; nullptr: none. Compressed, positions are rounded to 4
  /// micrometres.
  const bake::PoseRecording* motion = nullptr;
  /// EXT_meshopt_compression and KHR_mesh_quantization: an eighth of the size, points moved by half
  /// a step of their grid at most. Not all programs read it.
  bool compressed = false;
  int point_bits = 14;     ///< compressed: steps of that grid over the mesh, 2^bits, 8 to 16 bits
  bool colliders = false;  ///< also shapes of colliders, which other programs show as if seen
};

/// One scene. Its root turns the world to glTF's Y-up; below it a node for each body of the view,
/// in order, then one for what stands still ("world"), below each what is drawn of it. Every node's
/// `extras` has {"kind": "body", "world", "visual" or "collider", "path", "index"}; those of the
/// scene have {"tenon": {...}}, what page/src/scene/info.ts lists: bodies, joints, colliders, ...
/// Errors: Limit where the file would be larger than glTF's 4 GiB; Invalid for a motion of other
/// bodies; Missing without meshoptimizer where `compressed`.
Result<std::string> write_glb(const view::ViewScene& view, const GlbOptions& options);

}  // namespace tenon::glb
