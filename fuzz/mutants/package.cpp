// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Packages: damaged layers in whole packages, and packages whose headers lie.
#include <string>
#include <utility>

#include "fuzz/crate_parts.h"
#include "fuzz/mutants/mutant.h"
#include "fuzz/mutants/zip_parts.h"
#include "fuzz/text_mutations.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/open_layer.h"

namespace tenon::fuzz {
namespace {

constexpr const char* kNames[] = {
    "../out.usda",   "/etc/passwd", "a/../../b.usda", "a\\b.usda", "",
    "root.usda",     "a//b.usda",   "./root.usda",    "con\nrol",  "\xff\xfe.usda",
    "deep/er/x.png", "a.usdz"};

void mutate_claims(ZipClaims& claims, Dice& dice) {
  switch (dice.below(6)) {
    case 0:
      claims.method = static_cast<std::uint16_t>(dice.one_in(2) ? 8 : dice.extreme());
      break;
    case 1:
      claims.flags = static_cast<std::uint16_t>(1u << dice.below(16));
      break;
    case 2:
      claims.crc = static_cast<std::uint32_t>(dice.number());
      break;
    case 3:
      claims.packed_size = static_cast<std::uint32_t>(dice.extreme());
      break;
    case 4:
      claims.plain_size = static_cast<std::uint32_t>(dice.extreme());
      break;
    default:
      claims.name = kNames[dice.below(std::size(kNames))];
      break;
  }
}

void mutate_zip(ZipParts& zip, Dice& dice) {
  ZipPart& part = zip.parts[dice.below(zip.parts.size())];
  switch (dice.below(11)) {
    case 0:
      mutate_claims(part.local, dice);
      break;
    case 1:
      mutate_claims(part.central, dice);
      break;
    case 2: {  // both headers claim the same
      Dice same = dice;
      mutate_claims(part.local, same);
      mutate_claims(part.central, dice);
      break;
    }
    case 3:
      part.offset = static_cast<std::uint32_t>(dice.one_in(2) ? dice.extreme() : 0);
      break;
    case 4:
      part.extra = dice.below(200);
      break;
    case 5:
      zip.count = static_cast<std::uint16_t>(dice.extreme());
      break;
    case 6:
      (dice.one_in(2) ? zip.directory_offset : zip.directory_size) =
          static_cast<std::uint32_t>(dice.extreme());
      break;
    case 7:
      part.wide = dice.one_in(3) ? dice.extreme() : part.bytes.size();
      break;
    case 8:
      zip.wide_offset = dice.one_in(3) ? dice.extreme() : dice.below(2000);
      break;
    case 9:
      zip.comment = std::string(dice.below(70'000) % 65'536, 'P');
      break;
    default: {  // many entries, some of one place
      const ZipPart copy = part;
      const std::size_t count = std::size_t{1} << dice.below(9);
      for (std::size_t i = 0; i < count; ++i) {
        zip.parts.push_back(copy);
        zip.parts.back().name = dice.one_in(3) ? copy.name : "e" + std::to_string(i) + ".usda";
        zip.parts.back().bytes = dice.one_in(2) ? "" : copy.bytes.substr(0, 2000);
        if (dice.one_in(2)) {
          zip.parts.back().offset = 0;
        }
      }
      break;
    }
  }
}

std::string a_layer(const Seeds& seeds, bool damaged, std::string& name, Dice& dice) {
  const Seed& seed = seeds.pick(Kind::Text, dice);
  const bool crate = dice.one_in(2);
  name = crate ? "root.usdc" : "root.usda";
  std::string bytes = seed.bytes;
  if (crate) {
    Diagnostics diagnostics;
    const auto layer = formats::read_layer(bytes::FileBytes::own(bytes), seed.path, diagnostics);
    const auto written = layer ? formats::write_crate(*layer) : Result<std::string>("");
    bytes = written ? *written : bytes;
    return damaged ? mutate_crate(bytes, dice.number(), kLargestMutant) : bytes;
  }
  return damaged ? mutate_text(bytes, {Grammar::Usd, "", kLargestMutant}, dice) : bytes;
}

constexpr const char* kUsesInner = "#usda 1.0\nover \"A\" (references = @inner.usdz@)\n{\n}\n";

/// A package, at times within packages, each of which names the one that it holds.
std::string nested_packages(const Seeds& seeds, Dice& dice) {
  ZipParts inner;
  inner.parts.resize(1);
  inner.parts[0].bytes = a_layer(seeds, false, inner.parts[0].name, dice);
  std::string bytes = put_together(inner);
  for (std::size_t left = dice.one_in(3) ? dice.below(60) : 0; left > 0; --left) {
    ZipParts outer;
    outer.parts.push_back({"root.usda", kUsesInner, {}, {}, {}, 0, {}});
    outer.parts.push_back({"inner.usdz", std::move(bytes), {}, {}, {}, 0, {}});
    bytes = put_together(outer);
  }
  return bytes;
}

}  // namespace

Mutant make_package(const Seeds& seeds, Dice& dice) {
  const std::size_t what = dice.below(8);  // 0, 1: a layer; 2: bytes; others: headers
  ZipParts zip;
  zip.parts.resize(1);
  zip.parts[0].bytes = a_layer(seeds, what < 2, zip.parts[0].name, dice);
  if (dice.one_in(2) && seeds.has(Kind::Png)) {
    zip.parts.push_back({"textures/a.png", seeds.pick(Kind::Png, dice).bytes, {}, {}, {}, 0, {}});
  }
  if (dice.one_in(3)) {
    zip.parts.push_back({"inner.usdz", nested_packages(seeds, dice), {}, {}, {}, 0, {}});
    zip.parts.push_back({"more.usda", kUsesInner, {}, {}, {}, 0, {}});
  }
  for (std::size_t left = what > 2 ? 1 + dice.below(3) : 0; left > 0; --left) {
    mutate_zip(zip, dice);
  }
  std::string bytes = put_together(zip);
  for (std::size_t left = what == 2 ? 1 + dice.below(4) : 0; left > 0; --left) {
    mutate_bytes(bytes, dice);
  }
  if (dice.one_in(16)) {
    bytes.resize(dice.below(bytes.size() + 1));
  }
  Mutant mutant;
  mutant.asset = "mutant.usdz";
  mutant.files.push_back({mutant.asset, std::move(bytes)});
  return mutant;
}

}  // namespace tenon::fuzz
