// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/check/subject.h"

/// Whether what a stage leaves unsaid is likely to be what USD takes then, for fixes that write it
/// down.
namespace tenon::check {

/// Bodies and gravity look as they do in centimetres: sizes of a centimetre and more, densities of
/// matter, no gravity that is the earth's in another unit.
bool may_be_centimetres(const Subject& subject);
/// Densities are those of matter with masses in kilograms.
bool may_be_kilograms(const Subject& subject);
/// No gravity is authored that pulls along another axis than Y.
bool may_have_y_up(const Subject& subject);

}  // namespace tenon::check
