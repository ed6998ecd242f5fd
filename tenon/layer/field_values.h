// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// All types that a Value can hold, complete.
#include "tenon/layer/arcs.h"
#include "tenon/layer/array_edit.h"
#include "tenon/layer/dictionary.h"
#include "tenon/layer/lists/list_op.h"
#include "tenon/layer/scalar_types.h"
#include "tenon/layer/time/spline.h"
#include "tenon/layer/time/time_samples.h"
#include "tenon/layer/value.h"
