// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"
#include "tenon/robot/robot_model.h"

/// SRDF, what MoveIt knows of a robot beside its URDF: here the pairs of links whose collisions it
/// disables.
namespace tenon::urdf {

struct DisabledCollision {
  std::string link1;
  std::string link2;
  std::string reason;    ///< "Adjacent", "Always", "Default", "Never", "User" and the like
  robot::Place place{};  ///< in the file that was read
};

/// The disable_collisions of an SRDF file, in its order; all else in it is for MoveIt, and skipped.
/// Errors, with file and line: NotFound, Io, Parse (srdf.xml, and urdf.missing for an attribute),
/// Unsupported (srdf.root), Limit (file.too-large, and pairs.too-many for more than kListedPairs).
Result<std::vector<DisabledCollision>> read_srdf(const std::string& path, const bytes::Files& files,
                                                 Diagnostics& diagnostics);
/// The same of text at hand; `path` names it in messages.
Result<std::vector<DisabledCollision>> read_srdf_text(std::string_view text,
                                                      const std::string& path,
                                                      Diagnostics& diagnostics);

/// An SRDF file of these pairs alone.
std::string write_srdf(const std::string& robot, const std::vector<DisabledCollision>& pairs);

}  // namespace tenon::urdf
