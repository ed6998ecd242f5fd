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

/// What sums leave where nothing should be becomes 0: less than 1e-15 of the largest, which counts
/// as `least` where it is smaller: 1 for places [m] and turns.
void drop_noise(std::span<double> numbers, double least = 1);

}  // namespace tenon
