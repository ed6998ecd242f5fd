// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/vendors/vendor_attributes.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "tenon/schema/registry.h"

namespace tenon::physics {
namespace {

struct VendorRow {
  std::string_view name;
  VendorUse use = VendorUse::Read;
};

constexpr VendorRow kVendorRows[] = {
#define TENON_READ(name) {name, VendorUse::Read},
#define TENON_HARMLESS(name, why) {name, VendorUse::Harmless},
#include "tenon/physics/vendors/vendor_attributes.def"
};

constexpr bool comes_first(const VendorRow& a, const VendorRow& b) { return a.name < b.name; }
static_assert(std::is_sorted(std::begin(kVendorRows), std::end(kVendorRows), comes_first));

const VendorRow* find_vendor_row(std::string_view name) {
  const VendorRow wanted{name};
  const VendorRow* found =
      std::lower_bound(std::begin(kVendorRows), std::end(kVendorRows), wanted, comes_first);
  return found != std::end(kVendorRows) && found->name == name ? found : nullptr;
}

}  // namespace

VendorUse use_of_vendor_attribute(std::string_view name) {
  const VendorRow* row = find_vendor_row(name);
  for (std::size_t at = name.find(':'); row == nullptr && at != std::string_view::npos;
       at = name.find(':', at + 1)) {
    const std::string before(name.substr(0, at + 1));
    const std::size_t next = name.find(':', at + 1);
    if (next != std::string_view::npos) {
      row = find_vendor_row(before + "*" + std::string(name.substr(next)));
    }
    row = row == nullptr ? find_vendor_row(before + "*") : row;
  }
  return row == nullptr ? VendorUse::NotRead : row->use;
}

namespace {

/// Properties that are read where `unless` is applied, and not of `schema` alone.
struct UnreadRow {
  const char* schema;    ///< an API, or a type
  const char* property;  ///< empty: all that it declares
  const char* unless;    ///< APIs, with spaces between
};
constexpr const char* kEqualities = "MjcEqualityConnectAPI MjcEqualityJointAPI MjcEqualityWeldAPI";
constexpr UnreadRow kUnread[] = {
    {"IsaacLightBeamSensor", "enabled", ""},
    {"IsaacLightBeamSensor", "maxRange", ""},
    {"IsaacLightBeamSensor", "minRange", ""},
    {"IsaacLightBeamSensor", "numRays", ""},
    {"IsaacLightBeamSensor", "xformOpOrder", ""},
    {"MjcEqualityAPI", "mjc:solimp", kEqualities},
    {"MjcEqualityAPI", "mjc:solref", kEqualities},
    {"MjcEqualityAPI", "mjc:target", "MjcEqualityJointAPI"},
    {"MjcJointAPI", "mjc:actuatorfrclimited", ""},
    {"MjcJointAPI", "mjc:actuatorfrcrange:max", ""},
    {"MjcJointAPI", "mjc:actuatorfrcrange:min", ""},
    {"MjcJointAPI", "mjc:margin", "MjcCollisionAPI"},
    {"NewtonDCMotorClampingAPI", "", "NewtonJointAPI"},
};

bool has_any_api(const stage::Prim& prim, std::string_view apis) {
  while (!apis.empty()) {
    const std::size_t space = std::min(apis.find(' '), apis.size());
    if (prim.has_api(Token(apis.substr(0, space)))) {
      return true;
    }
    apis.remove_prefix(std::min(space + 1, apis.size()));
  }
  return false;
}

bool declares(Token schema, Token property) {
  const schema::Schema* found = schema::Registry::instance().find(schema);
  return found != nullptr && std::any_of(found->properties.begin(), found->properties.end(),
                                         [&](const auto& p) { return p.name == property; });
}

}  // namespace

VendorUse use_of_vendor_attribute(const stage::Prim& prim, Token name) {
  const VendorUse use = use_of_vendor_attribute(name.view());
  if (use != VendorUse::Read) {
    return use;
  }
  for (const UnreadRow& row : kUnread) {
    const bool named = *row.property == '\0' ? declares(row.schema, name) : name == row.property;
    const bool has = prim.has_api(row.schema) || prim.type_name() == row.schema;
    if (named && has && !has_any_api(prim, row.unless)) {
      return VendorUse::NotRead;
    }
  }
  return use;
}

bool is_vendor_attribute(const stage::Prim& prim, Token name) {
  const std::string_view text = name.view();
  if (text.starts_with("physx") || text.starts_with("newton:") || text.starts_with("mjc:")) {
    return true;
  }
  const schema::PrimDefinition* definition = prim.definition();
  const schema::PropertyDefinition* declared =
      definition == nullptr ? nullptr : definition->find(name);
  return declared != nullptr && declared->vendor;
}

}  // namespace tenon::physics
