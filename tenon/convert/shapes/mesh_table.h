// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tenon/convert/robot_layer.h"
#include "tenon/convert/shapes/material_writer.h"
#include "tenon/guard/workers.h"
#include "tenon/mesh/mesh_scene.h"

/// Internal to this folder.
namespace tenon::convert {

/// A polygon mesh as values of a layer, shared by all prims that show it.
struct MeshValues {
  std::string name;
  layer::Value points;
  layer::Value face_counts;
  layer::Value face_points;
  layer::Value normals;
  const char* normals_interpolation = "faceVarying";  ///< or "uniform": one for each face
  layer::Value texture_coordinates;                   ///< empty: none
  layer::Value extent;
  std::optional<robot::Index> material;  ///< a number of MaterialWriter
};

/// Writes them as those of a prim of the type Mesh.
void write_mesh(LayerBuilder& builder, Path prim, const MeshValues& mesh);

/// The meshes of a robot, each read when the first shape shows it.
class MeshTable {
 public:
  /// All of it outlives this. `materials` takes up how meshes look.
  MeshTable(const Source& source, MaterialWriter& materials, RobotLayer& layer)
      : source_(source), materials_(materials), layer_(layer) {}

  /// The parts of a mesh of the model; none where it is not there, or cannot be read, which is
  /// reported. Stays valid as long as the table.
  const std::vector<MeshValues>& parts(robot::Index mesh);

 private:
  std::vector<MeshValues> read(const robot::MeshFile& file);
  /// Keeps what the description means of a file, where it says that.
  void choose_part(const robot::MeshFile& file, std::vector<mesh::PolygonMesh>& meshes);

  const Source& source_;
  MaterialWriter& materials_;
  RobotLayer& layer_;
  std::map<robot::Index, std::vector<MeshValues>> parts_;
  guard::Workers workers_;  // for files that are read elsewhere
};

}  // namespace tenon::convert
