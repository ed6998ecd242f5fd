// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Mesh files and images, each beside a robot that names it.
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "fuzz/mutants/mutant.h"
#include "fuzz/mutants/zip_parts.h"
#include "fuzz/text_mutations.h"
#include "tenon/bytes/byte_writer.h"

namespace tenon::fuzz {
namespace {

/// The mesh beside a URDF that shows and collides with it, or a model of MuJoCo where that can.
Mutant robot_with(const Seeds& seeds, const Seed& seed, std::string bytes, bool by_mujoco) {
  Mutant mutant = mutant_of(seeds, seed, std::move(bytes));
  const std::string mesh = mutant.asset;
  if (by_mujoco) {
    mutant.asset = "model.xml";
    mutant.bound = Bound::Guarded;
    mutant.files.push_back(
        {mutant.asset, "<mujoco><asset><mesh name=\"m\" file=\"" + mesh +
                           "\"/></asset><worldbody><body><freejoint/><geom type=\"mesh\" "
                           "mesh=\"m\"/></body></worldbody></mujoco>\n"});
    return mutant;
  }
  const std::string shape = "<geometry><mesh filename=\"" + mesh + "\"/></geometry>";
  mutant.asset = "robot.urdf";
  mutant.files.push_back({mutant.asset, "<robot name=\"r\"><link name=\"l\"><visual>" + shape +
                                            "</visual><collision>" + shape +
                                            "</collision></link></robot>\n"});
  return mutant;
}

/// Triangles as STL has them in binary, some of them with numbers that are none.
std::string binary_stl(Dice& dice) {
  bytes::ByteWriter out;
  const auto count = static_cast<std::uint32_t>(1 + dice.below(40));
  out.write_text(std::string(80, dice.one_in(4) ? 's' : '\0'));
  out.write(dice.one_in(4) ? static_cast<std::uint32_t>(dice.extreme()) : count);
  static constexpr float kOdd[] = {0,
                                   -1,
                                   1e38f,
                                   1e-44f,
                                   std::numeric_limits<float>::infinity(),
                                   std::numeric_limits<float>::quiet_NaN()};
  for (std::uint32_t i = 0; i < count; ++i) {
    for (int number = 0; number < 12; ++number) {
      out.write(dice.one_in(30) ? kOdd[dice.below(std::size(kOdd))]
                                : static_cast<float>(dice.below(5)) - 2);
    }
    out.write(static_cast<std::uint16_t>(dice.one_in(20) ? dice.extreme() : 0));
  }
  return out.take();
}

/// Corners and triangles of a box as box.gltf reads them.
std::string box_numbers() {
  bytes::ByteWriter out;
  for (int i = 0; i < 8; ++i) {
    for (const int bit : {4, 2, 1}) {
      out.write((i & bit) != 0 ? 1.0f : -1.0f);
    }
  }
  static constexpr std::uint16_t kCorners[] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5,
                                               0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6,
                                               0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
  for (const std::uint16_t corner : kCorners) {
    out.write(corner);
  }
  return out.take();
}

std::string damaged(const Seeds& seeds, const Seed& seed, Grammar grammar, Dice& dice) {
  return mutate_text(seed.bytes, {grammar, seeds.pick(seed.kind, dice).bytes, kLargestMutant},
                     dice);
}

/// The checksums of the chunks made right again, so that damage reaches what is in them.
void mend_png(std::string& png) {
  std::size_t at = 8;
  while (at + 12 <= png.size()) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      length = length << 8 | static_cast<unsigned char>(png[at + i]);
    }
    if (length > png.size() - at - 12) {
      return;
    }
    const std::uint32_t crc = crc32(std::string_view(png).substr(at + 4, length + 4));
    for (std::size_t i = 0; i < 4; ++i) {
      png[at + 8 + length + i] = static_cast<char>(crc >> (24 - 8 * i));
    }
    at += 12 + length;
  }
}

/// A JPEG up to where its pixels begin.
std::string jpeg_head(Dice& dice) {
  bytes::ByteWriter out;
  const auto side = [&] {
    return static_cast<std::uint16_t>(dice.one_in(3) ? dice.extreme() : 0x1000);
  };
  const auto segment = [&](const char* marker, const std::string& bytes) {
    const std::size_t size = dice.one_in(12) ? dice.extreme() : bytes.size() + 2;
    out.write_text(std::string_view(marker, 2));
    out.write(static_cast<std::uint8_t>(size >> 8));
    out.write(static_cast<std::uint8_t>(size));
    out.write_text(bytes);
  };
  out.write_text("\xff\xd8");
  segment("\xff\xe0", std::string("JFIF\0\1\1\0\0\1\0\1\0\0", 14));
  for (std::size_t left = dice.one_in(4) ? dice.below(2000) : dice.below(3); left > 0; --left) {
    segment(dice.one_in(2) ? "\xff\xe1" : "\xff\xfe", std::string(dice.below(60), 'E'));
  }
  bytes::ByteWriter frame;
  frame.write(std::uint8_t{8});
  frame.write(side());
  frame.write(side());
  frame.write_text(std::string("\3\1\x11\0\2\x11\0\3\x11\0", 10));
  segment(dice.one_in(3) ? "\xff\xc2" : "\xff\xc0", frame.bytes());
  segment("\xff\xda", std::string("\3\1\0\2\0\3\0\0?\0", 10));
  out.write_text("\xff\xd9");
  return out.take();
}

constexpr const char* kTextured = R"(#usda 1.0
(
    defaultPrim = "A"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "A"
{
    def Mesh "Box" (
        prepend apiSchemas = ["MaterialBindingAPI", "PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]
    )
    {
        int[] faceVertexCounts = [3, 3, 3, 3]
        int[] faceVertexIndices = [0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        texCoord2f[] primvars:st = [(0, 0), (1, 0), (0, 1), (1, 1)] (
            interpolation = "vertex"
        )
        rel material:binding = </A/Look>
    }
    def Material "Look"
    {
        token outputs:surface.connect = </A/Look/Surface.outputs:surface>
        def Shader "Surface"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor.connect = </A/Look/Image.outputs:rgb>
            token outputs:surface
        }
        def Shader "Image"
        {
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = @./IMAGE@
            float2 inputs:st.connect = </A/Look/Reader.outputs:result>
            float3 outputs:rgb
        }
        def Shader "Reader"
        {
            uniform token info:id = "UsdPrimvarReader_float2"
            string inputs:varname = "st"
            float2 outputs:result
        }
    }
}
)";

}  // namespace

Mutant make_stl(const Seeds& seeds, Dice& dice) {
  const Seed& seed = seeds.pick(Kind::Stl, dice);
  std::string bytes = seed.bytes;
  if (dice.one_in(2)) {
    bytes = binary_stl(dice);
    for (std::size_t left = dice.below(3); left > 0; --left) {
      mutate_bytes(bytes, dice);
    }
  } else {
    bytes = damaged(seeds, seed, Grammar::Mesh, dice);
  }
  return robot_with(seeds, seed, std::move(bytes), dice.one_in(4));
}

Mutant make_obj(const Seeds& seeds, Dice& dice) {
  const Seed& seed = seeds.pick(Kind::Obj, dice);
  Mutant mutant =
      robot_with(seeds, seed, damaged(seeds, seed, Grammar::Mesh, dice), dice.one_in(4));
  if (dice.one_in(5)) {
    for (NamedFile& file : mutant.files) {
      if (file.name.ends_with(".mtl")) {
        file.bytes = mutate_text(file.bytes, {Grammar::Mesh, seed.bytes, kLargestMutant}, dice);
      }
    }
  }
  return mutant;
}

Mutant make_dae(const Seeds& seeds, Dice& dice) {
  const Seed& seed = seeds.pick(Kind::Dae, dice);
  Mutant mutant = robot_with(seeds, seed, damaged(seeds, seed, Grammar::Xml, dice), false);
  mutant.bound = Bound::Guarded;
  return mutant;
}

Mutant make_gltf(const Seeds& seeds, Dice& dice) {
  const Seed& seed = seeds.pick(Kind::Gltf, dice);
  std::string numbers = box_numbers();
  if (dice.one_in(4)) {
    mutate_bytes(numbers, dice);
  }
  Mutant mutant = robot_with(seeds, seed, damaged(seeds, seed, Grammar::Json, dice), false);
  mutant.files.push_back({"box.bin", std::move(numbers)});
  mutant.bound = Bound::Guarded;
  return mutant;
}

Mutant make_glb(const Seeds& seeds, Dice& dice) {
  const Seed& seed = seeds.pick(Kind::Gltf, dice);
  std::string json = dice.one_in(4) ? seed.bytes : damaged(seeds, seed, Grammar::Json, dice);
  if (const std::size_t uri = json.find(", \"uri\": \"box.bin\""); uri != std::string::npos) {
    json.erase(uri, 18);
  }
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::string numbers = box_numbers();
  const auto length = [&](std::size_t size) {
    return static_cast<std::uint32_t>(dice.one_in(8) ? dice.extreme() : size);
  };
  bytes::ByteWriter out;
  out.write_text("glTF");
  out.write(std::uint32_t{dice.one_in(20) ? 1u : 2u});
  out.write(length(28 + json.size() + numbers.size()));
  out.write(length(json.size()));
  out.write_text("JSON");
  out.write_text(json);
  out.write(length(numbers.size()));
  out.write_text(std::string_view("BIN\0", 4));
  out.write_text(numbers);
  std::string bytes = out.take();
  if (dice.one_in(3)) {
    mutate_bytes(bytes, dice);
  }
  Mutant mutant = robot_with(seeds, seed, "", false);
  NamedFile& mesh = mutant.files[mutant.files.size() - 2];
  mesh = {"mutant.glb", std::move(bytes)};
  std::string& robot = mutant.files.back().bytes;
  for (std::size_t at; (at = robot.find("mutant.gltf")) != std::string::npos;) {
    robot.replace(at, 11, "mutant.glb");
  }
  mutant.bound = Bound::Guarded;
  return mutant;
}

Mutant make_image(const Seeds& seeds, Dice& dice) {
  const Seed& seed = seeds.pick(Kind::Png, dice);
  std::string bytes = seed.bytes;
  if (dice.one_in(4)) {  // behind the end, where readers do not look
    bytes += std::string(dice.below(5000), 'x');
  } else {
    for (std::size_t left = 1 + dice.below(4); left > 0; --left) {
      mutate_bytes(bytes, dice);
    }
    if (!dice.one_in(4)) {
      mend_png(bytes);
    }
  }
  Mutant mutant;
  mutant.asset = "model.xml";
  const char* const use = dice.one_in(2)
                              ? "<texture name=\"t\" type=\"2d\" file=\"mutant.png\"/>"
                              : "<hfield name=\"h\" file=\"mutant.png\" size=\"1 1 1 1\"/>";
  mutant.files.push_back({"mutant.png", std::move(bytes)});
  mutant.files.push_back({mutant.asset, "<mujoco><asset>" + std::string(use) +
                                            "<texture name=\"u\" type=\"2d\" file=\"mutant.png\"/>"
                                            "<material name=\"m\" texture=\"u\"/></asset>"
                                            "<worldbody><geom size=\"1\" material=\"m\"/>"
                                            "</worldbody></mujoco>\n"});
  mutant.bound = Bound::Guarded;
  return mutant;
}

Mutant make_texture(const Seeds& seeds, Dice& dice) {
  const bool jpeg = dice.one_in(2);
  std::string bytes = jpeg ? jpeg_head(dice) : seeds.pick(Kind::Png, dice).bytes;
  for (std::size_t left = dice.below(4); left > 0; --left) {
    mutate_bytes(bytes, dice);
  }
  if (!jpeg && dice.one_in(2)) {
    mend_png(bytes);
  }
  Mutant mutant;
  const std::string name = dice.one_in(2) == jpeg ? "mutant.jpg" : "mutant.png";
  mutant.files.push_back({name, std::move(bytes)});
  mutant.asset = "model.usda";
  std::string text = kTextured;
  text.replace(text.find("IMAGE"), 5, name);
  mutant.files.push_back({mutant.asset, std::move(text)});
  mutant.prim = "/A";
  return mutant;
}

}  // namespace tenon::fuzz
