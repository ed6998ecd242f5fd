// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/properties/known_attributes.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "tenon/base/text/text_hash.h"

namespace tenon::formats::text {
namespace {

/// A head is in one of two slots.
std::array<std::size_t, 2> places_of(std::string_view head, std::size_t slots) {
  const std::uint64_t hash = text_hash(head);
  return {static_cast<std::size_t>(hash % slots), static_cast<std::size_t>((hash >> 32u) % slots)};
}

}  // namespace

KnownAttribute* KnownAttributes::find(std::string_view rest) {
  if (known_.empty() || rest.empty()) {
    return nullptr;
  }
  // Most often what followed the last one the last time.
  const std::uint32_t guess = known_[last_].next;
  if (rest.starts_with(known_[guess].text)) {
    last_ = guess;
    return &known_[guess];
  }
  const void* const equals =
      std::memchr(rest.data(), '=', std::min<std::size_t>(rest.size(), kLongestHead));
  if (equals == nullptr) {
    return nullptr;
  }
  const auto length = static_cast<std::size_t>(static_cast<const char*>(equals) - rest.data()) + 1;
  const std::string_view head = rest.substr(0, length);
  for (const std::size_t place : places_of(head, slots_.size())) {
    const std::uint32_t number = slots_[place];
    if (number != 0 && known_[number - 1].text == head) {
      return &follow(number - 1);
    }
  }
  return nullptr;
}

KnownAttribute* KnownAttributes::note(std::string_view text, const AttributeHead& head,
                                      const layer::FieldList& declared) {
  if (text.size() > kLongestHead || text.find('=') + 1 != text.size()) {
    return nullptr;
  }
  slots_.resize(kSlots);
  const auto [first, second] = places_of(text, slots_.size());
  std::uint32_t& number =
      slots_[first] != 0 && slots_[second] == 0 ? slots_[second] : slots_[first];
  if (number == 0) {
    known_.emplace_back();
    number = static_cast<std::uint32_t>(known_.size());
  }
  KnownAttribute& known = follow(number - 1);
  known = {text, head, declared, {}, known.next};
  return &known;
}

KnownAttribute& KnownAttributes::follow(std::uint32_t known) {
  known_[last_].next = known;
  last_ = known;
  return known_[known];
}

const layer::FieldList* KnownAttributes::repeated(const KnownAttribute& known,
                                                  std::string_view rest) {
  const KnownLine& line = known.line;
  return line.fields.id() != nullptr && rest.starts_with(line.text) ? &line.fields : nullptr;
}

bool KnownAttributes::note_line(KnownAttribute& known, std::string_view rest, std::size_t length,
                                std::size_t value_begin, const layer::FieldList& fields) {
  if (length >= std::min(rest.size(), kLongestLine) ||
      (rest[length] != '\n' && rest[length] != '\r')) {
    return false;
  }
  const std::string_view text = rest.substr(0, length + 1);
  const bool again = known.line.text == text;
  known.line = {text, value_begin, again ? fields : layer::FieldList()};
  return true;
}

}  // namespace tenon::formats::text
