// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/make_data_type.h"
#include "tenon/scene/fields/scene_fields.h"

namespace tenon::scene {

template const DataType& data_type<PhysicsScene>();

}  // namespace tenon::scene
