// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/stage/prim.h"

namespace tenon::physics {

/// What becomes of a property that a vendor's schema declares (vendor_attributes.def).
enum class VendorUse : unsigned char {
  Read,      ///< into the neutral description or its vendor parts
  Harmless,  ///< no influence on motion
  NotRead,   ///< listed in PhysicsScene::not_read
};

/// `name` with its instance: "physxMimicJoint:rotX:gearing".
VendorUse use_of_vendor_attribute(std::string_view name);

/// The same of a property of a prim: of schemas that nothing is read of it is not read, whatever
/// others call so.
VendorUse use_of_vendor_attribute(const stage::Prim& prim, Token name);

/// A property that only schemas of vendors declare, or whose name begins like theirs.
bool is_vendor_attribute(const stage::Prim& prim, Token name);

}  // namespace tenon::physics
