// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/known_metadata.h"

#include "tenon/base/text/text_hash.h"

namespace tenon::formats::text {
namespace {

constexpr std::size_t kSlots = 256;
constexpr std::size_t kLongestLine = 256;

/// By the first line with something in it behind the '('.
std::size_t slot_of(std::string_view rest) {
  const std::string_view start = rest.substr(0, kLongestLine);
  const bool opens_line = start.size() > 1 && (start[1] == '\n' || start[1] == '\r');
  return text_hash(start.substr(0, start.find('\n', opens_line ? 3 : 1))) % kSlots;
}

}  // namespace

std::size_t KnownMetadata::take(std::string_view rest, layer::Spec& spec) const {
  if (slots_.empty()) {
    return 0;
  }
  const Known& known = slots_[slot_of(rest)];
  if (known.text.empty() || known.kind != spec.kind || !rest.starts_with(known.text)) {
    return 0;
  }
  constexpr std::size_t kToCome = 2;  // most often the names of properties and children
  spec.reserve_fields(spec.fields().size() + known.fields.size() + kToCome);
  for (const layer::Field& field : known.fields) {
    spec.append(field.name, field.value);
  }
  return known.text.size();
}

void KnownMetadata::note(std::string_view block, const layer::Spec& spec, std::size_t first) {
  if (block.size() > kLongestBlock) {
    return;
  }
  if (slots_.empty()) {
    slots_.resize(kSlots);
  }
  Known& known = slots_[slot_of(block)];
  known = {block, spec.kind, {}};
  const layer::FieldRange fields = spec.fields();
  for (std::size_t i = first; i < fields.size(); ++i) {
    known.fields.push_back(fields[i]);
  }
}

}  // namespace tenon::formats::text
