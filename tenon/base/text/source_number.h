// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace tenon {

/// A number as an asset most likely had it, for text that people read. USD's physics holds floats,
/// and angles in degrees: of 0.1 they leave 0.10000000149011612, of 1.5 rad 1.4999999985. Such a
/// number becomes the shortest decimal that the same float comes of; one that lies within a few
/// last bits of a short decimal becomes that decimal; every other number keeps all its bits
/// (layer_text()). So nothing moves by more than a float's own rounding, 6e-8 of it. -0 becomes 0.
std::string source_number(double value);

/// What sums of places and turns leave where nothing should be (1e-17 beside 0.3, or alone)
/// becomes 0.
void drop_noise(std::span<double> numbers);

}  // namespace tenon
