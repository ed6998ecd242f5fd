// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutants/mutant.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "fuzz/crate_parts.h"
#include "fuzz/text_mutations.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/open_layer.h"

namespace tenon::fuzz {
namespace {

/// "/name" of a prim that the text defines, for verbs that are given one.
std::string a_prim_of(std::string_view text, Dice& dice) {
  std::size_t at = text.find("def ", dice.below(text.size() + 1));
  at = at == std::string_view::npos ? text.find("def ") : at;
  const std::size_t open = at == std::string_view::npos ? at : text.find('"', at);
  const std::size_t close =
      open == std::string_view::npos ? open : text.find_first_of("\"\n", open + 1);
  return close == std::string_view::npos
             ? "/"
             : "/" + std::string(text.substr(open + 1, close - open - 1));
}

Mutant make_text(const Seeds& seeds, Dice& dice) {
  const Seed& seed = seeds.pick(Kind::Text, dice);
  const TextMutation how{Grammar::Usd, seeds.pick(Kind::Text, dice).bytes, kLargestMutant};
  std::string bytes = mutate_text(seed.bytes, how, dice);
  std::string prim = a_prim_of(bytes, dice);
  Mutant mutant = mutant_of(seeds, seed, std::move(bytes));
  mutant.prim = std::move(prim);
  return mutant;
}

/// The text of the seed as a crate; its bytes where it cannot be one.
std::string crate_of(const Seed& seed) {
  if (seed.kind == Kind::Crate) {
    return seed.bytes;
  }
  Diagnostics diagnostics;
  const auto layer = formats::read_layer(bytes::FileBytes::own(seed.bytes), seed.path, diagnostics);
  const auto crate = layer ? formats::write_crate(*layer) : Result<std::string>("");
  return crate ? *crate : seed.bytes;
}

Mutant make_crate(const Seeds& seeds, Dice& dice) {
  const Kind kind = seeds.has(Kind::Crate) && dice.one_in(8) ? Kind::Crate : Kind::Text;
  const Seed& seed = seeds.pick(kind, dice);
  std::string bytes = mutate_crate(crate_of(seed), dice.number(), kLargestMutant);
  Mutant mutant = mutant_of(seeds, seed, std::move(bytes));
  mutant.prim = a_prim_of(seed.bytes, dice);
  if (dice.one_in(2)) {  // a layer of either kind may be called .usd
    mutant.asset = "mutant.usdc";
    mutant.files.back().name = mutant.asset;
  }
  return mutant;
}

/// Mostly a file that is right before it is damaged: the corpora are full of those that are not.
const Seed& a_robot(const Seeds& seeds, Kind kind, Dice& dice) {
  const Seed* seed = &seeds.pick(kind, dice);
  for (int tries = 0; tries < 6 && !seed->path.starts_with("seeds/"); ++tries) {
    seed = &seeds.pick(kind, dice);
  }
  return *seed;
}

Mutant make_robot(const Seeds& seeds, Kind kind, Dice& dice) {
  const Seed& seed = a_robot(seeds, kind, dice);
  const TextMutation how{Grammar::Xml, seeds.pick(kind, dice).bytes, kLargestMutant};
  Mutant mutant = mutant_of(seeds, seed, mutate_text(seed.bytes, how, dice));
  const bool foreign_meshes =
      std::any_of(seed.companions.begin(), seed.companions.end(), [&](std::size_t companion) {
        const Kind of = seeds.at(companion).kind;
        return of == Kind::Dae || of == Kind::Gltf;
      });
  mutant.bound = kind == Kind::Mjcf || foreign_meshes ? Bound::Guarded : Bound::File;
  return mutant;
}

Mutant make_urdf(const Seeds& seeds, Dice& dice) { return make_robot(seeds, Kind::Urdf, dice); }
Mutant make_mjcf(const Seeds& seeds, Dice& dice) { return make_robot(seeds, Kind::Mjcf, dice); }
Mutant make_sdf(const Seeds& seeds, Dice& dice) { return make_robot(seeds, Kind::Sdf, dice); }
Mutant make_arcs(const Seeds&, Dice& dice) { return make_arc_graph(dice); }

/// How many of a hundred inputs are of each format.
struct Format {
  const char* name;
  std::size_t share;
  Mutant (*make)(const Seeds& seeds, Dice& dice);
};
constexpr Format kFormats[] = {
    {"text layers", 15, make_text},
    {"binary layers", 13, make_crate},
    {"packages", 9, make_package},
    {"URDF", 7, make_urdf},
    {"MJCF", 8, make_mjcf},
    {"SDF", 4, make_sdf},
    {"STL", 3, make_stl},
    {"OBJ", 3, make_obj},
    {"Collada", 5, make_dae},
    {"glTF", 3, make_gltf},
    {"GLB", 3, make_glb},
    {"images", 1, make_image},
    {"textures", 2, make_texture},
    {"splines and clips", 4, make_motion},
    {"graphs of arcs", 5, make_arcs},
    {"files beside", 7, make_beside},
    {"crates of no writer", 3, make_odd_crate},
    {"odd names", 2, make_odd_name},
    {"unreadable files", 2, make_unreadable},
    {"unsteady files", 1, make_unsteady},
};

const Format& format_at(std::size_t number) {
  std::size_t turn = number * 37 % 100;  // so that a few in a row are of many formats
  const Format* format = kFormats;
  while (turn >= format->share) {
    turn -= format->share;
    ++format;
  }
  return *format;
}

}  // namespace

std::size_t Mutant::size() const {
  std::size_t size = 0;
  for (const NamedFile& file : files) {
    size += file.bytes.size();
  }
  return size;
}

Mutant make_mutant(const Seeds& seeds, std::size_t number, Dice& dice) {
  const Format& format = format_at(number);
  Mutant mutant = format.make(seeds, dice);
  mutant.format = format.name;
  return mutant;
}

std::string format_of(std::size_t number) { return format_at(number).name; }

Mutant mutant_of(const Seeds& seeds, const Seed& seed, std::string bytes) {
  Mutant mutant;
  const std::size_t folder = folder_of(seed.path).size();
  for (const std::size_t companion : seed.companions) {
    const Seed& file = seeds.at(companion);
    mutant.files.push_back({file.path.substr(folder), file.bytes});
  }
  static constexpr std::array<std::string_view, kKinds> kNames = {
      "mutant.usda", "mutant.usd", "mutant.usdz", "mutant.urdf", "mutant.xml", "mutant.sdf",
      "mutant.stl",  "mutant.obj", "mutant.dae",  "mutant.gltf", "mutant.png", "mutant"};
  mutant.asset = kNames[static_cast<std::size_t>(seed.kind)];
  mutant.files.push_back({mutant.asset, std::move(bytes)});
  return mutant;
}

}  // namespace tenon::fuzz
