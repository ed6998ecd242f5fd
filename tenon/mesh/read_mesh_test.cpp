// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mesh/read_mesh.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tenon/mesh/assimp_scene.h"

namespace tenon::mesh {
namespace {

namespace fs = std::filesystem;

const bytes::ReadPolicy kAnywhere = bytes::ReadPolicy::unrestricted();

/// A folder of its own for each test.
class ReadMesh : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("tenon_mesh_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& contents) {
    std::ofstream(folder_ / name, std::ios::binary) << contents;
    return (folder_ / name).string();
  }

  /// As programs read; formats of others by tenon-worker.
  Result<MeshScene> read(const std::string& path, Diagnostics& findings) {
    return read_mesh(path, {workers_, kAnywhere}, findings);
  }

  Diagnostics findings_;
  guard::Workers workers_;

 private:
  fs::path folder_;
};

TEST_F(ReadMesh, TakesPlyAsTextAndInBothOrdersOfBytes) {
  const auto header = [](const std::string& form) {
    return "ply\nformat " + form +
           " 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property double z\nproperty uchar red\nelement face 2\n"
           "property list uchar int vertex_indices\nproperty short mark\nend_header\n";
  };
  const auto packed = [&](bool little) {
    std::string bytes = header(little ? "binary_little_endian" : "binary_big_endian");
    const auto put = [&](const auto& value) {
      std::string part(reinterpret_cast<const char*>(&value), sizeof(value));
      bytes += little ? part : std::string(part.rbegin(), part.rend());
    };
    for (const Vec2f& at : {Vec2f{{0, 0}}, Vec2f{{1, 0}}, Vec2f{{1, 1}}, Vec2f{{0, 1}}}) {
      put(at[0]);
      put(at[1]);
      put(0.5);
      put(static_cast<unsigned char>(200));
    }
    for (const std::vector<std::int32_t>& face : {std::vector<std::int32_t>{0, 1, 2, 3}, {3, 1}}) {
      put(static_cast<unsigned char>(face.size()));
      for (const std::int32_t point : face) {
        put(point);
      }
      put(static_cast<std::int16_t>(-1));
    }
    return bytes;
  };
  const std::string text = header("ascii") +
                           "0 0 0.5 200\n1 0 .5 200\n1 1 0.5 200\n0 1 0.5 200\n"
                           "4 0 1 2 3 -1\n2 3 1 -1\n";
  for (const std::string& contents : {text, packed(true), packed(false)}) {
    const auto scene = read(write("a.ply", contents), findings_);
    ASSERT_TRUE(scene) << scene.error().to_string();
    const PolygonMesh& mesh = scene->meshes.at(0);
    EXPECT_EQ(mesh.points.at(2), (Vec3f{{1, 1, 0.5}}));
    EXPECT_EQ(mesh.face_counts, std::vector<std::int32_t>{4});
    EXPECT_EQ(mesh.face_points, (std::vector<std::int32_t>{0, 1, 2, 3}));
    for (std::size_t size = 0; size < contents.size() - 4; ++size) {  // cut anywhere: no crash
      EXPECT_FALSE(read(write("b.ply", contents.substr(0, size)), findings_)) << size;
    }
  }
  std::string huge = text;
  huge.replace(huge.find("vertex 4"), 8, "vertex 4000000000");
  EXPECT_EQ(read(write("c.ply", huge), findings_).error().diagnostic().rule, "mesh.ply");
}

/// A binary STL whose triangles have these corners.
std::string binary_stl(const std::vector<Vec3f>& corners, std::uint32_t count,
                       const std::string& header) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % 3 == 0) {
      bytes.append(12, '\0');
    }
    bytes.append(reinterpret_cast<const char*>(&corners[i]), 12);
    if (i % 3 == 2) {
      bytes.append(2, '\0');
    }
  }
  return bytes;
}

const std::vector<Vec3f> kTwoTriangles = {{{0, 0, 0}},    {{0.1f, 0, 0}},  {{0, 0.3f, 0}},
                                          {{0.1f, 0, 0}}, {{1, 1, 1e-7f}}, {{-0.0f, 0.3f, 0}}};

TEST_F(ReadMesh, KeepsEveryBitOfABinaryStl) {
  const auto scene =
      read(write("a.STL", binary_stl(kTwoTriangles, 2, "solid but binary")), findings_);
  ASSERT_TRUE(scene) << scene.error().to_string();
  const PolygonMesh& mesh = scene->meshes.at(0);
  EXPECT_EQ(mesh.points,
            (std::vector<Vec3f>{{{0, 0, 0}}, {{0.1f, 0, 0}}, {{0, 0.3f, 0}}, {{1, 1, 1e-7f}}}));
  EXPECT_EQ(mesh.face_points, (std::vector<std::int32_t>{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(mesh.face_counts, (std::vector<std::int32_t>{3, 3}));
}

TEST_F(ReadMesh, ReadsStlText) {
  const auto scene = read_stl(
      "solid x\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1e-1 0 0\n"
      "   vertex 0 +3.0E-1 0\n  endloop\n endfacet\nendsolid x\n",
      "x.stl");
  ASSERT_TRUE(scene) << scene.error().to_string();
  EXPECT_EQ(scene->meshes[0].points,
            (std::vector<Vec3f>{{{0, 0, 0}}, {{0.1f, 0, 0}}, {{0, 0.3f, 0}}}));
}

TEST_F(ReadMesh, RefusesStlsThatContradictThemselves) {
  EXPECT_EQ(read_stl(binary_stl(kTwoTriangles, 1000000000, ""), "x.stl").error().code(),
            ErrorCode::Corrupt);
  EXPECT_EQ(read_stl(binary_stl({}, 0, ""), "x.stl").error().code(), ErrorCode::Corrupt);
  EXPECT_EQ(read_stl("", "x.stl").error().code(), ErrorCode::Corrupt);
  const auto cut = read_stl("solid x\nfacet\nvertex 0 0 0\nvertex 1 0\n", "x.stl");
  EXPECT_EQ(cut.error().code(), ErrorCode::Parse);
  EXPECT_EQ(cut.error().diagnostic().line, 4u);
}

// Where the file that is whole ends before its last line, it is no STL, wherever it is cut.
TEST_F(ReadMesh, RefusesStlsThatAreCut) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\n";
  const std::string text = "solid x\n" + facet + facet + "endsolid";
  ASSERT_TRUE(read_stl(text, "x.stl"));
  ASSERT_TRUE(read_stl("solid\n" + facet + "end solid\n", "x.stl"));
  const std::string binary = binary_stl(kTwoTriangles, 2, "solid but binary");
  for (const std::string& whole : {text, binary}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto cut = read_stl(whole.substr(0, size), "x.stl");
      ASSERT_FALSE(cut) << size;
      EXPECT_EQ(cut.error().diagnostic().file, "x.stl");
      EXPECT_EQ(cut.error().diagnostic().rule, "mesh.stl");
    }
  }
  const auto cut = read_stl("solid x\n" + facet, "x.stl");
  EXPECT_EQ(cut.error().diagnostic().line, 8u);
  EXPECT_NE(cut.error().message().find("line 1: it has no \"endsolid\""), std::string::npos);
  EXPECT_NE(read_stl(binary.substr(0, 150), "x.stl").error().message().find("counts 2 triangles"),
            std::string::npos);
  EXPECT_EQ(read_stl("solid x\nfacet\nvertex 0 0 0\nendsolid\n", "x.stl").error().code(),
            ErrorCode::Parse);
}

TEST_F(ReadMesh, RefusesStlsWithPointsThatAreNoNumbers) {
  for (const float bad : {NAN, INFINITY, -INFINITY}) {
    std::vector<Vec3f> corners = kTwoTriangles;
    corners[4] = {{1, bad, 0}};
    const auto scene = read_stl(binary_stl(corners, 2, ""), "x.stl");
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().diagnostic().rule, "mesh.not-finite");
    EXPECT_NE(scene.error().message().find("triangle 2 has"), std::string::npos);
  }
  const auto text =
      read_stl("solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 nan 0\nendfacet\n", "x.stl");
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().diagnostic().rule, "mesh.not-finite");
  EXPECT_EQ(text.error().diagnostic().line, 5u);
}

TEST_F(ReadMesh, RefusesObjWithPointsThatAreNoNumbers) {
  for (const char* bad : {"nan", "inf", "-inf", "NAN", "+Infinity"}) {
    const auto scene = read_obj("v 0 0 0\nv 1 " + std::string(bad) + " 0\nv 0 1 0\nf 1 2 3\n",
                                "x.obj", kAnywhere, findings_);
    ASSERT_FALSE(scene) << bad;
    EXPECT_EQ(scene.error().diagnostic().rule, "mesh.not-finite") << bad;
    EXPECT_EQ(scene.error().diagnostic().line, 2u) << bad;
  }
}

TEST_F(ReadMesh, DoesWithoutNormalsAndColoursThatAreNoNumbers) {
  write("n.mtl", "newmtl a\nKd nan 0.5 inf\nnewmtl b\nd nan\n");
  const std::string path =
      write("n.obj",
            "mtllib n.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 nan\nvn 0 0 1\nvt inf 0\nvt 0 0\n"
            "usemtl a\nf 1/1/1 2/1/1 3/1/1\nusemtl b\nf 1/2/2 2/2/2 3/2/2\n");
  const auto scene = read(path, findings_);
  ASSERT_TRUE(scene) << scene.error().to_string();
  ASSERT_EQ(scene->meshes.size(), 2u);
  EXPECT_TRUE(scene->meshes[0].normals.empty());
  EXPECT_TRUE(scene->meshes[0].texture_coordinates.empty());
  EXPECT_EQ(scene->meshes[1].normals.size(), 3u);
  EXPECT_EQ(scene->meshes[1].texture_coordinates.size(), 3u);
  EXPECT_EQ(scene->appearances[0].color, (Vec4f{{1, 0.5f, 1, 1}}));
  EXPECT_EQ(scene->appearances[1].color, (Vec4f{{1, 1, 1, 1}}));
  std::vector<std::uint32_t> lines;
  for (const Diagnostic& finding : findings_.items()) {
    EXPECT_EQ(finding.rule, "mesh.not-finite");
    lines.push_back(finding.line);
  }
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{2, 4, 10, 10}));  // once for each list
}

TEST_F(ReadMesh, NamesTheLineOfAFaceThatNamesNoPoint) {
  for (const char* face : {"f 1 2 4", "f 1 2 -4", "f 1 2 0", "f 1 2 2147483648"}) {
    const auto scene = read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + std::string(face) + "\n", "x.obj",
                                kAnywhere, findings_);
    ASSERT_FALSE(scene) << face;
    EXPECT_EQ(scene.error().diagnostic().line, 4u) << face;
    EXPECT_NE(scene.error().message().find("of 3 so far"), std::string::npos) << face;
  }
}

TEST_F(ReadMesh, ReadsObjWithMaterials) {
  write("m.mtl", "newmtl red\nKd 1 0.25 0\nd 0.5\nnewmtl wood\nmap_Kd -s 1 1 1 planks.png\n");
  const std::string path = write(
      "m.obj",
      "mtllib m.mtl\nv 0 0 0\nv 0.1 0 0\nv 0 0.1 0 \\\n\nv 0 0 0.1 # a corner\nvt 0 0\nvt 1 0\n"
      "vt 1 1\nvn 0 0 1\nusemtl red\nf 1 2 3\nusemtl wood\nf 1/1/1 -3/2/1 -1/3/1\nl 1 2\n");
  const auto scene = read(path, findings_);
  ASSERT_TRUE(scene) << scene.error().to_string();
  ASSERT_EQ(scene->meshes.size(), 2u);
  EXPECT_EQ(scene->meshes[0].points.size(), 3u);
  EXPECT_TRUE(scene->meshes[0].normals.empty());
  const PolygonMesh& wood = scene->meshes[1];
  EXPECT_EQ(wood.points, (std::vector<Vec3f>{{{0, 0, 0}}, {{0.1f, 0, 0}}, {{0, 0, 0.1f}}}));
  EXPECT_EQ(wood.face_points, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(wood.texture_coordinates, (std::vector<Vec2f>{{{0, 0}}, {{1, 0}}, {{1, 1}}}));
  EXPECT_EQ(wood.normals.size(), 3u);
  EXPECT_EQ(scene->appearances[0].color, (Vec4f{{1, 0.25f, 0, 0.5f}}));
  EXPECT_TRUE(scene->appearances[1].texture.ends_with("/planks.png"));
  ASSERT_EQ(findings_.size(), 1u);  // the line
  EXPECT_EQ(findings_.items()[0].rule, "mesh.left-out");
}

TEST_F(ReadMesh, RefusesBadObj) {
  for (const char* text : {"v 0 0\n", "v 0 0 0\nf 1 2 3\n", "v 0 0 0\nf 1 1\n", "", "f 0 0 0\n",
                           "v 0 0 0\nf 1//2 1 1\n", "v 0 0 0\nf 99999999999999999999 1 1\n"}) {
    const auto scene = read_obj(text, "x.obj", kAnywhere, findings_);
    ASSERT_FALSE(scene) << text;
    EXPECT_EQ(scene.error().code(), ErrorCode::Parse) << text;
  }
}

// Nothing says where an OBJ ends, but its last line does.
TEST_F(ReadMesh, WarnsOfAnObjWhoseLastLineHasNoEnd) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n";
  ASSERT_TRUE(read_obj(text, "x.obj", kAnywhere, findings_));
  EXPECT_TRUE(findings_.items().empty());
  ASSERT_TRUE(read_obj(text.substr(0, text.size() - 1), "x.obj", kAnywhere, findings_));
  ASSERT_EQ(findings_.items().size(), 1u);
  EXPECT_EQ(findings_.items()[0].rule, "mesh.may-be-cut");
  EXPECT_EQ(findings_.items()[0].line, 5u);
}

constexpr const char* kCollada = R"(<?xml version="1.0"?>
<COLLADA version="1.4.1">
 <asset><unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
 <library_geometries><geometry id="g" name="tri"><mesh>
  <source id="p"><float_array id="pa" count="9">0 0 0 10 0 0 0 30 0</float_array>
   <technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
   <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
  </source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n"><translate>100 0 0</translate>
  <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";

TEST_F(ReadMesh, ReadsColladaInMetresWithItsAxes) {
  if (!has_assimp()) {
    GTEST_SKIP() << "assimp is not installed";
  }
  const auto scene = read(write("t.dae", kCollada), findings_);
  ASSERT_TRUE(scene) << scene.error().to_string();
  const PolygonMesh& mesh = scene->meshes.at(0);
  ASSERT_EQ(mesh.points.size(), 3u);
  EXPECT_NEAR(mesh.points[1][0], 1.1f, 1e-6);
  EXPECT_NEAR(mesh.points[2][1], 0.3f, 1e-6);
  EXPECT_EQ(mesh.points[2][2], 0);
}

// Positions 0 0 0, 1 0 0, 0 0.1 0 as floats.
constexpr const char* kGltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"translation":[0,0,2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"name":"blue","pbrMetallicRoughness":{"baseColorFactor":[0,0,1,1]}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
"min":[0,0,0],"max":[1,0.1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,
AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAM3MzD0AAAAA"}]})";

TEST_F(ReadMesh, ReadsGltfToTheBit) {
  if (!has_assimp()) {
    GTEST_SKIP() << "assimp is not installed";
  }
  std::string text = kGltf;
  std::erase(text, '\n');
  const auto scene = read(write("t.gltf", text), findings_);
  ASSERT_TRUE(scene) << scene.error().to_string();
  EXPECT_EQ(scene->meshes.at(0).points,
            (std::vector<Vec3f>{{{0, 0, 2}}, {{1, 0, 2}}, {{0, 0.1f, 2}}}));
  EXPECT_EQ(scene->appearances.at(*scene->meshes[0].appearance).color, (Vec4f{{0, 0, 1, 1}}));
}

TEST_F(ReadMesh, TakesImagesOfGltfFromInsideAndBeside) {
  if (!has_assimp()) {
    GTEST_SKIP() << "assimp is not installed";
  }
  // The bytes after "base64," are those of "picture"; nobody looks into them here.
  std::string text = kGltf;
  const std::string color = R"("pbrMetallicRoughness":{"baseColorFactor":[0,0,1,1]})";
  text.replace(text.find(color), color.size(),
               R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1],"roughnessFactor":0.25,
"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":1}},
"normalTexture":{"index":1},"alphaMode":"BLEND")");
  text.insert(text.rfind('}'), R"(,"textures":[{"source":0},{"source":1}],"images":[
{"uri":"data:image/png;base64,cGljdHVyZQ=="},{"uri":"rough.png"}])");
  std::erase(text, '\n');
  const std::string file = write("t.gltf", text);
  const auto scene = read(file, findings_);
  ASSERT_TRUE(scene) << scene.error().to_string();
  const Appearance& look = scene->appearances.at(*scene->meshes.at(0).appearance);
  EXPECT_EQ(look.texture, file + "[t_0.png]");
  ASSERT_EQ(scene->images.size(), 1u);
  EXPECT_EQ(scene->images.at(look.texture), "picture");
  EXPECT_TRUE(look.tinted);
  EXPECT_TRUE(look.texture_opacity);
  EXPECT_EQ(look.roughness, 0.25f);
  ASSERT_EQ(look.images.size(), 2u);
  EXPECT_EQ(look.images[0].use, ImageUse::Normal);
  EXPECT_EQ(look.images[1].use, ImageUse::RoughnessMetallic);
  EXPECT_TRUE(look.images[1].file.ends_with("/rough.png"));
  EXPECT_TRUE(findings_.empty());
}

TEST_F(ReadMesh, ListsWhatIsLeftOutOfTheLooksOfGltf) {
  if (!has_assimp()) {
    GTEST_SKIP() << "assimp is not installed";
  }
  struct Row {
    const char* material;
    std::size_t images;
    const char* finding;
  };
  const Row rows[] = {
      {R"("emissiveFactor":[0.5,0,0])", 0, "emits"},
      {R"("emissiveTexture":{"index":0})", 0, ""},
      {R"("emissiveFactor":[1,1,1],"emissiveTexture":{"index":0})", 1, ""},
      {R"("emissiveFactor":[1,0,1],"emissiveTexture":{"index":0})", 1, "emits"},
      {R"("normalTexture":{"index":0,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}})", 1,
       "transform"},
  };
  for (const Row& row : rows) {
    std::string text = kGltf;
    const std::string color = R"("pbrMetallicRoughness":{"baseColorFactor":[0,0,1,1]})";
    text.replace(text.find(color), color.size(), row.material);
    text.insert(text.rfind('}'),
                R"(,"extensionsUsed":["KHR_texture_transform"],"textures":[{"source":0}],)"
                R"("images":[{"uri":"light.png"}])");
    std::erase(text, '\n');
    Diagnostics findings;
    const auto scene = read(write("e.gltf", text), findings);
    ASSERT_TRUE(scene) << scene.error().to_string();
    const Appearance& look = scene->appearances.at(*scene->meshes.at(0).appearance);
    EXPECT_EQ(look.images.size(), row.images) << row.material;
    ASSERT_EQ(findings.size(), row.finding[0] == '\0' ? 0u : 1u) << row.material;
    if (!findings.empty()) {
      EXPECT_EQ(findings.items()[0].rule, "mesh.left-out");
      EXPECT_NE(findings.items()[0].message.find(row.finding), std::string::npos);
    }
  }
}

TEST_F(ReadMesh, SaysWhyAMeshCannotBeRead) {
  EXPECT_EQ(read("/nowhere/x.stl", findings_).error().code(), ErrorCode::NotFound);
  EXPECT_EQ(read("x.step", findings_).error().code(), ErrorCode::Unsupported);
  const char* const pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n";
  for (const char* name : {"pointer.stl", "pointer.obj", "pointer.dae"}) {
    const auto mesh = read(write(name, pointer), findings_);
    ASSERT_FALSE(mesh) << name;
    EXPECT_EQ(mesh.error().diagnostic().rule, "file.lfs-pointer") << name;
  }
  if (has_assimp()) {
    EXPECT_FALSE(read(write("bad.dae", "<COLLADA"), findings_));
    EXPECT_FALSE(read(write("bad.glb", "glTF\x02\x01"), findings_));
  }
}

}  // namespace
}  // namespace tenon::mesh
