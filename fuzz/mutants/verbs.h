// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuzz/dice.h"
#include "fuzz/mutants/mutant.h"

namespace tenon::fuzz {

/// What a run that ends with 0 leaves.
enum class Leaves : unsigned char {
  Text,     ///< something on standard output
  Nothing,  ///< perhaps nothing: an edit, an answer that is "yes"
  Layer,    ///< the file `output`, which reads back
  File,     ///< the file `output`
  Log,      ///< the same, and also where the answer is that the asset cannot be read
  Folder    ///< the folder `output`
};

/// A command line that fits the mutant.
struct Command {
  std::string row;                 ///< verb and what sets it apart, for the counts
  std::vector<std::string> words;  ///< behind the program's name
  Leaves leaves = Leaves::Text;
  std::string output;
  bool edits = false;               ///< writes into the asset's own files
  std::vector<std::string> before;  ///< words of a command that is run first; mostly none
};

Command command_for(const Mutant& mutant, Dice& dice);

}  // namespace tenon::fuzz
