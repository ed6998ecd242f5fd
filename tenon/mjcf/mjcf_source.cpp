// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/mjcf_source.h"

#include <cstdlib>
#include <string_view>

#include "tenon/base/file_finding.h"

namespace tenon::mjcf {
namespace {

/// MuJoCo keeps "line N" with each element that it has read from a file.
const mjString* info_of(mjsElement* element, mjtObj kind) {
  switch (kind) {
    case mjOBJ_ACTUATOR:
      return mjs_asActuator(element)->info;
    case mjOBJ_EQUALITY:
      return mjs_asEquality(element)->info;
    case mjOBJ_TENDON:
      return mjs_asTendon(element)->info;
    case mjOBJ_SENSOR:
      return mjs_asSensor(element)->info;
    case mjOBJ_KEY:
      return mjs_asKey(element)->info;
    case mjOBJ_CAMERA:
      return mjs_asCamera(element)->info;
    case mjOBJ_LIGHT:
      return mjs_asLight(element)->info;
    case mjOBJ_PAIR:
      return mjs_asPair(element)->info;
    case mjOBJ_MATERIAL:
      return mjs_asMaterial(element)->info;
    case mjOBJ_GEOM:
      return mjs_asGeom(element)->info;
    default:
      return nullptr;
  }
}

std::uint32_t line_in(const mjString* info) {
  const std::string_view text = info == nullptr ? "" : mjs_getString(info);
  const std::size_t at = text.find("line ");
  return at == std::string_view::npos
             ? 0
             : static_cast<std::uint32_t>(std::strtoul(text.data() + at + 5, nullptr, 10));
}

}  // namespace

std::string MjcfSource::written_name(mjtObj kind, int id) const {
  const char* name = mj_id2name(&model_, kind, id);
  return name == nullptr ? "" : name;
}

/// MuJoCo's names are unique in their kind; things without one get a number.
std::string MjcfSource::name(mjtObj kind, int id, const char* otherwise) const {
  std::string name = written_name(kind, id);
  return name.empty() ? std::string(otherwise) + "_" + std::to_string(id) : name;
}

mjsElement* MjcfSource::element(mjtObj kind, int id) const {
  const auto [known, is_new] = elements_.try_emplace(kind);
  if (is_new) {
    for (mjsElement* at = mjs_firstElement(&spec_, kind); at != nullptr;
         at = mjs_nextElement(&spec_, at)) {
      known->second.emplace(mjs_getId(at), at);
    }
  }
  const auto found = known->second.find(id);
  return found == known->second.end() ? nullptr : found->second;
}

std::vector<std::uint32_t> MjcfSource::lines_of(mjtObj kind) const {
  std::vector<std::uint32_t> lines;
  for (mjsElement* at = mjs_firstElement(&spec_, kind); at != nullptr;
       at = mjs_nextElement(&spec_, at)) {
    lines.push_back(line_in(info_of(at, kind)));
  }
  return lines;
}

std::uint32_t MjcfSource::line_of(mjtObj kind, int id) const {
  mjsElement* const found = element(kind, id);
  return found == nullptr ? 0 : line_in(info_of(found, kind));
}

void MjcfSource::report(Severity severity, const char* rule, std::string message,
                        std::uint32_t line) {
  diagnostics_.add(file_finding(severity, rule, std::move(message), file_, line));
}

void MjcfSource::left_out(std::string message, std::uint32_t line) {
  report(Severity::Warning, "mjcf.left-out", std::move(message), line);
}

std::string lines_text(const std::vector<std::uint32_t>& lines) {
  std::string text;
  for (const std::uint32_t line : lines) {
    if (line != 0) {
      text += (text.empty() ? "" : ", ") + std::to_string(line);
    }
  }
  const bool is_one = text.find(',') == std::string::npos;
  return text.empty() ? text : (is_one ? ": line " : ": lines ") + text;
}

}  // namespace tenon::mjcf
