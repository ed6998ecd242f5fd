// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Meshes that are not there, told after the whole description was read: many of one folder in one
// finding, and advice that names all that has to be given, so that one more run is enough.
#include <map>
#include <set>
#include <utility>

#include "tenon/urdf/urdf_reader.h"

namespace tenon::urdf {
namespace {

constexpr std::size_t kNamedOneByOne = 3;     ///< of a folder
constexpr std::size_t kOptionsTogether = 32;  ///< in the advice of each finding

std::string folder_of(const std::string& written) {
  return written.substr(0, written.find_last_of('/') + 1);
}

/// "--allow-read /a" of "..., give --allow-read /a"; empty where the advice has no option.
std::string option_of(const std::string& advice, const char* option) {
  const std::size_t at = advice.find(option);
  return at == std::string::npos ? std::string() : advice.substr(at);
}

/// `advice` with the option for all of `options` in the place of its own, unless they are many.
std::string with_all(const std::string& advice, const char* option,
                     const std::set<std::string>& options) {
  const std::string own = option_of(advice, option);
  if (own.empty() || options.size() > kOptionsTogether) {
    return advice;
  }
  std::string all;
  for (const std::string& one : options) {
    all += (all.empty() ? "" : " ") + one;
  }
  return advice.substr(0, advice.size() - own.size()) + all;
}

}  // namespace

void UrdfReader::report_missing_mesh(const std::string& written, pugi::xml_node element) {
  const auto refusal = refusals_.find(written);
  MissingMesh missing{element, written, "urdf.mesh-missing",
                      "the mesh \"" + written + "\" cannot be found", paths_.advice(written)};
  if (refusal != refusals_.end()) {
    const Diagnostic& why = refusal->second.diagnostic();
    missing.rule = why.rule;
    missing.message = "the mesh " + why.message;
    missing.advice = why.fix;
  }
  missing_meshes_.push_back(std::move(missing));
}

void report_missing_meshes(XmlReader& xml, const std::vector<MissingMesh>& meshes) {
  constexpr const char* kOptions[] = {"--allow-read", "--package"};
  struct Group {
    const MissingMesh* first = nullptr;
    std::set<std::string> names;
  };
  std::set<std::string> options[std::size(kOptions)];
  std::map<std::pair<std::string, std::string>, Group> groups;
  for (const MissingMesh& missing : meshes) {
    for (std::size_t i = 0; i < std::size(kOptions); ++i) {
      if (std::string one = option_of(missing.advice, kOptions[i]); !one.empty()) {
        options[i].insert(std::move(one));
      }
    }
    Group& group = groups[{missing.rule, folder_of(missing.written)}];
    group.first = group.first ? group.first : &missing;
    group.names.insert(missing.written);
  }
  for (const MissingMesh& missing : meshes) {
    const auto& [first, names] = groups[{missing.rule, folder_of(missing.written)}];
    const bool together = names.size() > kNamedOneByOne;
    if (together && first != &missing) {
      continue;
    }
    std::string advice = missing.advice;
    for (std::size_t i = 0; i < std::size(kOptions); ++i) {
      advice = with_all(advice, kOptions[i], options[i]);
    }
    const bool refused = missing.rule != "urdf.mesh-missing";
    const std::string what =
        together
            ? std::to_string(names.size()) + " meshes of the folder \"" +
                  folder_of(missing.written) + "\" " +
                  (refused ? "are outside of the folders that the asset may read"
                           : "cannot be found") +
                  ", the first is \"" + missing.written.substr(folder_of(missing.written).size()) +
                  "\"; their shapes are skipped"
            : missing.message + "; the shape is skipped";
    xml.warn(missing.element, missing.rule.c_str(), what, advice, Severity::Error);
  }
}

}  // namespace tenon::urdf
