// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/sensors/site_volume.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tenon::mjcf {
namespace {

constexpr std::pair<mjtGeom, const char*> kVolumes[] = {{mjGEOM_SPHERE, "sphere"},
                                                        {mjGEOM_CAPSULE, "capsule"},
                                                        {mjGEOM_ELLIPSOID, "ellipsoid"},
                                                        {mjGEOM_CYLINDER, "cylinder"},
                                                        {mjGEOM_BOX, "box"}};

}  // namespace

std::optional<robot::MujocoVolume> site_volume(const mjModel& model, std::size_t site) {
  mjsSite usual{};
  mjs_defaultSite(&usual);
  const int type = model.site_type[site];
  const mjtNum* size = model.site_size + 3 * site;
  const auto* known = std::find_if(std::begin(kVolumes), std::end(kVolumes),
                                   [&](const auto& row) { return row.first == type; });
  if (known == std::end(kVolumes) || (type == usual.type && size[0] == usual.size[0])) {
    return std::nullopt;
  }
  return robot::MujocoVolume{known->second, {size[0], size[1], size[2]}};
}

void set_site_volume(mjsSite& site, const robot::MujocoVolume& volume) {
  const auto* known = std::find_if(std::begin(kVolumes), std::end(kVolumes),
                                   [&](const auto& row) { return row.second == volume.type; });
  if (known != std::end(kVolumes) && volume.size[0] > 0) {
    site.type = known->first;
    std::copy(volume.size.begin(), volume.size.end(), site.size);
  }
}

}  // namespace tenon::mjcf
