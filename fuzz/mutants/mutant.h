// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/dice.h"
#include "fuzz/mutants/seeds.h"

/// Damaged inputs for the whole program: what tenon_mutants runs it on.
namespace tenon::fuzz {

/// Which memory a run may take: so much for the size of the files, what compositions may, what
/// docs/limits.md says of readers in a process of their own, or of arrays that are repeated in
/// text.
enum class Bound : unsigned char { File, Composition, Guarded, Arrays };

struct NamedFile {
  std::string name;  ///< relative, with '/' between folders
  std::string bytes;
};

/// One input: the files of a folder, one of which is what a verb is given.
struct Mutant {
  std::string format;  ///< row of the table of results
  std::vector<NamedFile> files;
  std::string asset;  ///< name of the file for the verb
  std::string prim = "/";
  Bound bound = Bound::File;
  std::string words;    ///< of the command that reads it, as in verbs.cpp; "": of any that fits
  bool edits = false;   ///< that command writes into the asset's own files
  std::string before;   ///< words of a command that makes the file `damaged` first
  std::string damaged;  ///< a saved state, which then is damaged by these dice
  std::uint64_t damage = 0;
  std::vector<NamedFile> links;  ///< symbolic links; `bytes` is where each leads
  std::string other;  ///< what the asset becomes, and back, while it is read; "": it stays

  std::size_t size() const;
};

/// The mutant of this number; equal seeds, equal mutants. Formats take turns in a fixed rhythm.
Mutant make_mutant(const Seeds& seeds, std::size_t number, Dice& dice);
/// Its row in the table of results.
std::string format_of(std::size_t number);

/// What the functions for single formats share: a seed's companions with the seed itself replaced.
Mutant mutant_of(const Seeds& seeds, const Seed& seed, std::string bytes);
/// The longest mutant [bytes].
inline constexpr std::size_t kLargestMutant = 2u << 20;

Mutant make_arc_graph(Dice& dice);
Mutant make_motion(const Seeds& seeds, Dice& dice);
Mutant make_package(const Seeds& seeds, Dice& dice);
Mutant make_stl(const Seeds& seeds, Dice& dice);
Mutant make_obj(const Seeds& seeds, Dice& dice);
Mutant make_dae(const Seeds& seeds, Dice& dice);
Mutant make_gltf(const Seeds& seeds, Dice& dice);
Mutant make_glb(const Seeds& seeds, Dice& dice);
Mutant make_image(const Seeds& seeds, Dice& dice);
Mutant make_texture(const Seeds& seeds, Dice& dice);
Mutant make_beside(const Seeds& seeds, Dice& dice);
Mutant make_odd_crate(const Seeds& seeds, Dice& dice);
Mutant make_odd_name(const Seeds& seeds, Dice& dice);
Mutant make_unreadable(const Seeds& seeds, Dice& dice);
Mutant make_unsteady(const Seeds& seeds, Dice& dice);

/// A state of `tenon sim --state-out` with another body, mostly under a digest that fits.
std::string damaged_state(std::string state, Dice& dice);

}  // namespace tenon::fuzz
