// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/answers/structured_json.h"

#include "tenon/structure/layout.h"

namespace tenon {

using answers::Json;

std::vector<PackageFile> package_files(const structure::Package& package) {
  std::vector<PackageFile> list;
  for (const auto& [name, file] : package.files) {
    const structure::Role role = structure::role_of_file_name(name);
    list.push_back({name, std::string(structure::role_name(role)), file.bytes->size()});
  }
  return list;
}

Json structured_json(const structure::StructuredAsset& asset) {
  Json body = Json::object();
  body["interface"] = asset.package.interface;
  body["files"] = Json::array();
  for (const PackageFile& file : package_files(asset.package)) {
    body["files"].push_back({{"file", file.name}, {"role", file.role}, {"bytes", file.bytes}});
  }
  body["variants"] = asset.physics_variants;
  body["selection"] = asset.selection;
  body["moved"] = Json::array();
  for (const auto& [from, to] : asset.moved) {
    body["moved"].push_back({{"from", from.str()}, {"to", to.str()}});
  }
  return body;
}

}  // namespace tenon
