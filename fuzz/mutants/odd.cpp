// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Good files under odd names, names longer than paths may be, files that cannot be read, and files
// that change while they are read.
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "fuzz/mutants/mutant.h"
#include "fuzz/text_mutations.h"

namespace tenon::fuzz {
namespace {

constexpr std::string_view kStems[] = {"\xff\xfe",
                                       "\xc3\x28",
                                       "\xed\xa0\x80",
                                       "\xf4\x90\x80\x80",
                                       "a\nb",
                                       "a\tb",
                                       "\x1b[31m",
                                       "%s%n",
                                       " ",
                                       "a b ",
                                       "'",
                                       "\"",
                                       "a[0]",
                                       "a@b",
                                       "a#1",
                                       "$(x)",
                                       "..",
                                       "~",
                                       "a.usdz[b]",
                                       "\xe2\x80\xae"
                                       "x",
                                       "a;b&c",
                                       "*",
                                       "a\\b",
                                       "\xc3\xa9",
                                       "e\xcc\x81",
                                       "nul",
                                       "a\x7f",
                                       "\xf0\x9f\xa4\x96"};

/// A seed, damaged or not, with its companions.
Mutant a_layer(const Seeds& seeds, Dice& dice) {
  const Seed& seed = seeds.pick(Kind::Text, dice);
  std::string bytes = seed.bytes;
  if (dice.one_in(3)) {
    bytes = mutate_text(bytes, {Grammar::Usd, "", kLargestMutant}, dice);
  }
  return mutant_of(seeds, seed, std::move(bytes));
}

/// A layer that names this one in every way there is.
void name_it(Mutant& mutant, const std::string& name) {
  const std::string quoted = "@@@" + name + "@@@";
  std::string text = "#usda 1.0\n(\n    subLayers = [" + quoted + "]\n)\n";
  text += "def \"A\" (\n    references = " + quoted + "\n    payload = " + quoted + "</A>\n)\n{\n";
  text += "    asset a = " + quoted + "\n    asset inputs:file = " + quoted + "\n}\n";
  mutant.asset = "root.usda";
  mutant.files.push_back({mutant.asset, text});
}

}  // namespace

Mutant make_odd_name(const Seeds& seeds, Dice& dice) {
  Mutant mutant = a_layer(seeds, dice);
  if (dice.one_in(4)) {  // longer than paths may be, by folders that are there or not
    std::string name;
    const std::string_view step = dice.one_in(2) ? "./" : "a/../";
    const std::size_t length = 3900 + dice.below(1000);
    while (name.size() < length) {
      name += step;
    }
    name += mutant.asset;
    if (dice.one_in(2)) {
      mutant.asset = name;
    } else {
      name_it(mutant, "./" + (dice.one_in(2) ? std::string(length, 'x') : name));
    }
    return mutant;
  }
  std::string stem(kStems[dice.below(std::size(kStems))]);
  if (dice.one_in(8)) {
    stem = std::string(200 + dice.below(50), 'n');
  }
  const std::string name = (dice.one_in(6) ? stem + "/" : "") + stem + ".usda";
  mutant.files.back().name = name;
  mutant.asset = "./" + name;
  if (dice.one_in(2)) {
    name_it(mutant, mutant.asset);
  }
  return mutant;
}

Mutant make_unreadable(const Seeds& seeds, Dice& dice) {
  static constexpr const char* kTargets[] = {
      "/proc/self/mem",  // a regular file of which reading fails with EIO
      "/proc/self/mem", "/dev/zero", "/dev/null", "/dev/full",      "missing",
      "bad.usda",       ".",         "/",         "/proc/self/fd/0"};
  static constexpr const char* kEndings[] = {".usda", ".usd", ".usdc", ".usdz",
                                             ".urdf", ".xml", ".sdf",  ".png"};
  Mutant mutant = a_layer(seeds, dice);
  const std::string name =
      std::string("bad") + kEndings[dice.below(dice.one_in(2) ? 1 : std::size(kEndings))];
  mutant.links.push_back({name, kTargets[dice.below(std::size(kTargets))]});
  if (dice.one_in(2)) {
    mutant.asset = name;
  } else {
    name_it(mutant, "./" + name);
  }
  return mutant;
}

Mutant make_unsteady(const Seeds& seeds, Dice& dice) {
  Mutant mutant = a_layer(seeds, dice);
  // From 64 kB on files are mapped. They never become shorter: docs/limits.md has what that does.
  std::string& bytes = mutant.files.back().bytes;
  if (dice.one_in(2)) {
    bytes += "#" + std::string(70'000, 'x') + "\n";
  }
  mutant.other = mutate_text(bytes, {Grammar::Usd, "", kLargestMutant}, dice);
  mutant.other.resize(std::max(mutant.other.size(), bytes.size()), dice.one_in(2) ? ' ' : '\0');
  return mutant;
}

}  // namespace tenon::fuzz
