// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The short path for programs that use tenon; docs/cpp has a page for each task. Nothing inside of
/// tenon includes this.

// Open and traverse.
#include "tenon/open_stage.h"
#include "tenon/stage/attribute.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/relationship.h"
#include "tenon/stage/stage.h"

// Read physics as every verb reads it.
#include "tenon/asset/physics_options.h"
#include "tenon/physics/read_physics.h"
#include "tenon/scene/physics_scene.h"

// Multibody algebra without an engine.
#include "tenon/dynamics/dynamics.h"
#include "tenon/dynamics/posture_text.h"

// Simulate.
#include "tenon/asset/simulating/simulate_asset.h"
#include "tenon/make_simulation.h"

// Author, edit files that others wrote, save.
#include "tenon/asset/edit_asset.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/formats/save_layer.h"

// Check and explain.
#include "tenon/asset/check_asset.h"
#include "tenon/asset/explain_asset.h"

// Structure and convert.
#include "tenon/asset/convert_file.h"
#include "tenon/asset/converting/robot_files.h"
#include "tenon/asset/export_mjcf.h"
#include "tenon/asset/export_urdf.h"
#include "tenon/asset/structure_asset.h"
