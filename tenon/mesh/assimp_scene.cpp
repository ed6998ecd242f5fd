// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The only file that knows assimp: its C interface, loaded when it is first asked for. Of the
// programs only tenon-worker has this in it.
#include "tenon/mesh/assimp_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string_view>

#include "tenon/base/file_finding.h"
#include "tenon/base/limits/limits.h"
#include "tenon/base/shared_library.h"
#include "tenon/math/matrix.h"
#include "tenon/mesh/point_welder.h"

#if TENON_WITH_ASSIMP
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#endif

namespace tenon::mesh {

#if TENON_WITH_ASSIMP
namespace {

/// What is used of the library, where it can be loaded.
struct Assimp {
  bool is_there = false;
  decltype(&aiImportFileExWithProperties) import_file = nullptr;
  decltype(&aiReleaseImport) release = nullptr;
  decltype(&aiGetErrorString) error_text = nullptr;
  decltype(&aiCreatePropertyStore) make_properties = nullptr;
  decltype(&aiReleasePropertyStore) release_properties = nullptr;
  decltype(&aiSetImportPropertyInteger) set_integer = nullptr;
  decltype(&aiGetMaterialString) material_string = nullptr;
  decltype(&aiGetMaterialColor) material_color = nullptr;
  decltype(&aiGetMaterialFloatArray) material_floats = nullptr;
  decltype(&aiGetVersionMajor) major = nullptr;
  decltype(&aiGetVersionMinor) minor = nullptr;
};

Assimp load_assimp() {
  Assimp a;
  const SharedLibrary library =
      SharedLibrary::open({TENON_ASSIMP_SONAME}, SharedLibrary::Binding::Lazy);
  if (library.find("aiImportFileExWithProperties", a.import_file) &&
      library.find("aiReleaseImport", a.release) &&
      library.find("aiGetErrorString", a.error_text) &&
      library.find("aiCreatePropertyStore", a.make_properties) &&
      library.find("aiReleasePropertyStore", a.release_properties) &&
      library.find("aiSetImportPropertyInteger", a.set_integer) &&
      library.find("aiGetMaterialString", a.material_string) &&
      library.find("aiGetMaterialColor", a.material_color) &&
      library.find("aiGetMaterialFloatArray", a.material_floats) &&
      library.find("aiGetVersionMajor", a.major) && library.find("aiGetVersionMinor", a.minor)) {
    a.is_there = true;
  }
  return a;
}

const Assimp& assimp() {
  static const Assimp loaded = load_assimp();
  return loaded;
}

struct Properties {
  Properties() : store(assimp().make_properties()) {}
  Properties(const Properties&) = delete;
  Properties& operator=(const Properties&) = delete;
  ~Properties() { assimp().release_properties(store); }
  aiPropertyStore* store;
};

struct Release {
  void operator()(const aiScene* scene) const { assimp().release(scene); }
};

Mat4d row_matrix(const aiMatrix4x4& m) {
  const float* at = &m.a1;
  Mat4d result;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      result[j][i] = static_cast<double>(at[4 * i + j]);
    }
  }
  return result;
}

/// v M without translation. Here, not in a library: it is asked for each corner of large meshes.
template <class Matrix>
Vec3d rotated(const aiVector3D& v, const Matrix& m) {
  const auto x = static_cast<double>(v.x);
  const auto y = static_cast<double>(v.y);
  const auto z = static_cast<double>(v.z);
  return {{x * m[0][0] + y * m[1][0] + z * m[2][0], x * m[0][1] + y * m[1][1] + z * m[2][1],
           x * m[0][2] + y * m[1][2] + z * m[2][2]}};
}

Vec3f moved(const aiVector3D& v, const Mat4d& m) {
  return to_float(rotated(v, m) + Vec3d{{m[3][0], m[3][1], m[3][2]}});
}

/// The larger one that is a number, as std::fmax has it.
double larger(double a, double b) { return a > b || std::isnan(b) ? a : b; }

/// As normalized() of a vector.
Vec3f turned_normal(const aiVector3D& n, const Mat3d& turn) {
  const Vec3d normal = rotated(n, turn);
  const double largest =
      larger(std::fabs(normal[0]), larger(std::fabs(normal[1]), std::fabs(normal[2])));
  if (!(largest > 0) || std::isinf(largest)) {
    return {};
  }
  const Vec3d scaled = normal * (1 / largest);
  return to_float(scaled * (1 / length(scaled)));
}

class SceneReader {
 public:
  SceneReader(const aiScene& scene, const std::string& path, Diagnostics& diagnostics)
      : scene_(scene), path_(path), diagnostics_(diagnostics) {}

  Result<MeshScene> run() {
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
      result_.appearances.push_back(appearance(*scene_.mMaterials[i]));
    }
    struct Open {
      const aiNode* node;
      Mat4d to_root;
    };
    std::vector<Open> open{{scene_.mRootNode, Mat4d::identity()}};
    while (!open.empty()) {
      const Open at = open.back();
      open.pop_back();
      const Mat4d to_root = row_matrix(at.node->mTransformation) * at.to_root;
      for (unsigned i = 0; i < at.node->mNumMeshes; ++i) {
        TENON_CHECK(add(*scene_.mMeshes[at.node->mMeshes[i]], to_root, *at.node));
      }
      for (unsigned i = at.node->mNumChildren; i-- > 0;) {
        open.push_back({at.node->mChildren[i], to_root});
      }
    }
    if (result_.meshes.empty()) {
      return Error(ErrorCode::Parse, "the file has no faces")
          .in_file(path_)
          .with_rule("mesh.assimp");
    }
    return std::move(result_);
  }

 private:
  void report(std::string message, std::string fix) {
    diagnostics_.add(file_finding(Severity::Warning, "mesh.left-out", std::move(message), path_, 0,
                                  std::move(fix)));
  }

  Appearance appearance(const aiMaterial& material) {
    Appearance look;
    look.linear = !path_.ends_with("dae") && !path_.ends_with("DAE");
    aiString text;
    if (assimp().material_string(&material, AI_MATKEY_NAME, &text) == AI_SUCCESS) {
      look.name = text.C_Str();
    }
    aiColor4D color;
    if (assimp().material_color(&material, "$clr.base", 0, 0, &color) == AI_SUCCESS ||
        assimp().material_color(&material, AI_MATKEY_COLOR_DIFFUSE, &color) == AI_SUCCESS) {
      look.color = Vec4f{{color.r, color.g, color.b, color.a}};
      float opacity = 1;
      unsigned count = 1;
      if (assimp().material_floats(&material, AI_MATKEY_OPACITY, &opacity, &count) == AI_SUCCESS &&
          count == 1) {
        (*look.color)[3] = opacity;
      }
    }
    look.texture = image(material, aiTextureType_BASE_COLOR);
    if (look.texture.empty()) {
      look.texture = image(material, aiTextureType_DIFFUSE);
    }
    if (look.linear) {
      take_gltf(material, look);
    }
    return look;
  }

  /// What glTF 2.0 (3.9) says beside a colour: factors, and images that they multiply.
  void take_gltf(const aiMaterial& material, Appearance& look) {
    const Vec4f white{{1, 1, 1, 1}};
    look.tinted = look.color && !(*look.color == white);
    aiString text;
    look.texture_opacity =
        !look.texture.empty() &&
        assimp().material_string(&material, "$mat.gltf.alphaMode", 0, 0, &text) == AI_SUCCESS &&
        std::string_view(text.C_Str()) != "OPAQUE";
    look.roughness = factor(material, "$mat.roughnessFactor");
    look.metallic = factor(material, "$mat.metallicFactor");
    const auto take = [&](aiTextureType type, ImageUse use) {
      if (std::string file = image(material, type); !file.empty()) {
        look.images.push_back({use, std::move(file)});
      }
    };
    take(aiTextureType_NORMALS, ImageUse::Normal);
    take(aiTextureType_LIGHTMAP, ImageUse::Occlusion);
    take(aiTextureType_UNKNOWN, ImageUse::RoughnessMetallic);
    if (emits(material, look.name)) {
      take(aiTextureType_EMISSIVE, ImageUse::Emission);
    }
  }

  /// Whether the image of emission counts: glTF multiplies it with a colour, which is black where
  /// the file says nothing. Colours other than white are unsupported.
  bool emits(const aiMaterial& material, const std::string& name) {
    aiColor4D color(0, 0, 0, 0);
    assimp().material_color(&material, AI_MATKEY_COLOR_EMISSIVE, &color);
    const bool black = color.r <= 0 && color.g <= 0 && color.b <= 0;
    const bool white = color.r >= 1 && color.g >= 1 && color.b >= 1;
    aiString image;
    const bool has_image =
        assimp().material_string(&material, AI_MATKEY_TEXTURE(aiTextureType_EMISSIVE, 0), &image) ==
            AI_SUCCESS &&
        image.length != 0;
    if (!black && !(white && has_image)) {
      report("the colour that the material \"" + name + "\" emits is skipped",
             "author inputs:emissiveColor of its surface");
    }
    return !black;
  }

  static std::optional<float> factor(const aiMaterial& material, const char* key) {
    float value = 0;
    unsigned count = 1;
    const bool found =
        assimp().material_floats(&material, key, 0, 0, &value, &count) == AI_SUCCESS && count == 1;
    return found && value >= 0 && value <= 1 ? std::optional(value) : std::nullopt;
  }

  /// The file of a material's first image of a kind; empty: none.
  std::string image(const aiMaterial& material, aiTextureType type) {
    aiString text;
    if (assimp().material_string(&material, AI_MATKEY_TEXTURE(type, 0), &text) != AI_SUCCESS ||
        text.length == 0) {
      return {};
    }
    const std::string name = text.C_Str();
    report_transform(material, type, name);
    for (unsigned i = 0; i < scene_.mNumTextures; ++i) {
      const aiTexture& inside = *scene_.mTextures[i];
      if (name == "*" + std::to_string(i) || name == inside.mFilename.C_Str()) {
        return inner_image(inside, i);
      }
    }
    if (name.starts_with('*')) {
      report("a texture names no image of the file; skipped", "export the mesh again");
      return {};
    }
    return (std::filesystem::path(path_).parent_path() / name).generic_string();
  }

  void report_transform(const aiMaterial& material, aiTextureType type, const std::string& name) {
    std::array<float, 5> transform{};  // translation, scaling, rotation
    auto count = static_cast<unsigned>(transform.size());
    if (assimp().material_floats(&material, AI_MATKEY_UVTRANSFORM(type, 0), transform.data(),
                                 &count) == AI_SUCCESS &&
        transform != std::array<float, 5>{0, 0, 1, 1, 0}) {
      report("the transform of the texture " + name + " is skipped",
             "apply it to the texture coordinates of the mesh");
    }
  }

  /// An image that lies inside the file, under a name of its own.
  std::string inner_image(const aiTexture& inside, unsigned number) {
    const std::string_view hint(inside.achFormatHint);
    const bool known = hint == "png" || hint == "jpg" || hint == "jpeg";
    if (inside.mHeight != 0 || inside.pcData == nullptr || !known) {
      report("the image " + std::to_string(number) + " of the file is neither PNG nor JPEG",
             "export the mesh with such images");
      return {};
    }
    const std::string name = std::filesystem::path(path_).stem().string() + "_" +
                             std::to_string(number) + "." + std::string(hint);
    const auto [at, is_new] = result_.images.try_emplace(path_ + "[" + name + "]");
    if (is_new) {
      at->second.assign(reinterpret_cast<const char*>(inside.pcData), inside.mWidth);
    }
    return at->first;
  }

  Result<void> add(const aiMesh& from, const Mat4d& to_root, const aiNode& node) {
    PolygonMesh mesh;
    mesh.name = from.mName.length > 0 ? from.mName.C_Str() : node.mName.C_Str();
    if (from.mMaterialIndex < result_.appearances.size()) {
      mesh.appearance = from.mMaterialIndex;
    }
    TENON_CHECK(add_faces(from, mesh));
    if (mesh.face_counts.empty()) {
      return {};
    }
    const std::vector<std::int32_t>& vertices = mesh.face_points;  // so far
    bool invertible = false;
    const Mat3d turn = transpose(inverse(upper_left(to_root), &invertible));
    if (from.mNormals != nullptr && invertible) {
      std::vector<Vec3f> normals(from.mNumVertices);
      std::transform(from.mNormals, from.mNormals + from.mNumVertices, normals.begin(),
                     [&](const aiVector3D& n) { return turned_normal(n, turn); });
      mesh.normals = at_corners(vertices, normals);
    }
    if (const aiVector3D* uv = from.mTextureCoords[0]) {
      std::vector<Vec2f> places(from.mNumVertices);
      std::transform(uv, uv + from.mNumVertices, places.begin(),
                     [](const aiVector3D& t) { return Vec2f{{t.x, t.y}}; });
      mesh.texture_coordinates = at_corners(vertices, places);
    }
    weld(from, to_root, mesh);
    result_.meshes.push_back(std::move(mesh));
    return {};
  }

  /// The faces, with numbers of vertices for those of points.
  Result<void> add_faces(const aiMesh& from, PolygonMesh& mesh) {
    mesh.face_counts.reserve(from.mNumFaces);
    mesh.face_points.reserve(from.mNumVertices);  // most files share none between corners
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
      const aiFace& face = from.mFaces[i];
      if (face.mNumIndices < 3) {
        ++lines_;
        continue;
      }
      corners_ += face.mNumIndices;
      if (corners_ > limits::kMeshCorners) {
        return Error(ErrorCode::Limit, "more corners of faces than a mesh may have")
            .in_file(path_)
            .with_rule("mesh.assimp");
      }
      mesh.face_counts.push_back(static_cast<std::int32_t>(face.mNumIndices));
      for (unsigned corner = 0; corner < face.mNumIndices; ++corner) {
        mesh.face_points.push_back(static_cast<std::int32_t>(face.mIndices[corner]));
      }
    }
    return {};
  }

  template <class T>
  static std::vector<T> at_corners(const std::vector<std::int32_t>& vertices,
                                   const std::vector<T>& values) {
    std::vector<T> found(vertices.size());
    std::transform(vertices.begin(), vertices.end(), found.begin(),
                   [&](std::int32_t vertex) { return values[static_cast<std::size_t>(vertex)]; });
    return found;
  }

  /// Puts points in the place of vertices, each as soon as a face has it.
  static void weld(const aiMesh& from, const Mat4d& to_root, PolygonMesh& mesh) {
    PointWelder welder(from.mNumVertices);
    std::vector<std::int32_t> numbers(from.mNumVertices, -1);  // of the vertices seen so far
    for (std::int32_t& corner : mesh.face_points) {
      const auto vertex = static_cast<std::size_t>(corner);
      if (numbers[vertex] < 0) {
        numbers[vertex] = welder.number(moved(from.mVertices[vertex], to_root));
      }
      corner = numbers[vertex];
    }
    mesh.points = welder.take_points();
  }

  const aiScene& scene_;
  const std::string& path_;
  Diagnostics& diagnostics_;
  MeshScene result_;
  std::size_t corners_ = 0;
  std::size_t lines_ = 0;
};

}  // namespace

bool has_assimp() { return assimp().is_there; }

std::string assimp_version() {
  return has_assimp() ? std::to_string(assimp().major()) + "." + std::to_string(assimp().minor())
                      : "";
}

Result<MeshScene> read_with_assimp(const std::string& path, Diagnostics& diagnostics) {
  if (!has_assimp()) {
    return Error(ErrorCode::Missing, "this mesh is read by assimp, which is not installed")
        .in_file(path)
        .with_rule("mesh.assimp")
        .with_fix("install libassimp5, or export the mesh as .obj or .stl");
  }
  const Properties properties;
  assimp().set_integer(properties.store, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  const std::unique_ptr<const aiScene, Release> scene(
      assimp().import_file(path.c_str(), 0, nullptr, properties.store));
  if (scene == nullptr || scene->mRootNode == nullptr) {
    return Error(ErrorCode::Corrupt,
                 std::string("the mesh cannot be read: ") + assimp().error_text())
        .in_file(path)
        .with_rule("mesh.assimp")
        .with_fix("export the mesh again");
  }
  return SceneReader(*scene, path, diagnostics).run();
}

#else

bool has_assimp() { return false; }
std::string assimp_version() { return ""; }

Result<MeshScene> read_with_assimp(const std::string& path, Diagnostics&) {
  return Error(ErrorCode::Missing, "this mesh is read by assimp, which is not part of this build")
      .in_file(path)
      .with_rule("mesh.assimp")
      .with_fix("export the mesh as .obj or .stl");
}

#endif

}  // namespace tenon::mesh
