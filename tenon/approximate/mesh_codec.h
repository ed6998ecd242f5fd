// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/math/vector.h"

/// Meshes for drawing, by meshoptimizer. Everything is nothing where it is not there.
namespace tenon::approximate {

/// meshoptimizer can be loaded and has what is needed here.
bool mesh_codec_is_there();

/// Elements of `stride` bytes, a multiple of 4 up to 256, as mode ATTRIBUTES of glTF's
/// EXT_meshopt_compression (version 0) has them.
std::optional<std::string> encoded_attributes(std::string_view bytes, std::size_t stride);

/// Triangles as mode TRIANGLES of EXT_meshopt_compression has them. Corners are below
/// `point_count`; each triangle may begin with another of its corners when it is read back.
std::optional<std::string> encoded_triangles(const std::vector<std::uint32_t>& corners,
                                             std::size_t point_count);

/// What meshoptimizer takes at most to order or simplify triangles: it looks at all triangles of a
/// point for each of them. Beyond limits::kMeshOptimizerWork meshes stay as they are.
std::size_t meshoptimizer_work(const std::vector<std::uint32_t>& corners, std::size_t point_count);

/// Puts triangles into an order that encodes well. Returns the new number of each point, by which
/// points are to be put into order, too; points that no triangle has get numbers behind all others.
/// Nothing where the limit is exceeded.
std::optional<std::vector<std::uint32_t>> put_in_order(std::vector<std::uint32_t>& corners,
                                                       std::size_t point_count);

/// The triangles of a mesh simplified to about `wanted` triangles: edges collapse by quadric errors
/// (Garland and Heckbert 1997) up to a tenth of the mesh's size. Corners still name the same
/// points. Nothing where the limit is exceeded.
std::optional<std::vector<std::uint32_t>> thinned_out(const std::vector<std::uint32_t>& corners,
                                                      const std::vector<Vec3f>& points,
                                                      std::size_t wanted);

}  // namespace tenon::approximate
