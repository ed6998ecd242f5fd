// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo writes each element of its text on one line, with attributes in double quotes. Numbers of
// points go into the files as they stand. In OBJ the second coordinate of images runs upward, in
// MJCF downward.
#include "tenon/asset/exporting/mesh_files.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/asset/exporting/obj_files.h"
#include "tenon/base/text/number_from_text.h"
#include "tenon/base/text/text_number.h"
#include "tenon/math/vector.h"
#include "tenon/scene/shapes/convex_hull.h"

namespace tenon {
namespace {

using Words = std::vector<std::string_view>;

Words words_of(std::string_view text) {
  Words words;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(" \n\t", at)) != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(" \n\t", at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

template <class T>
std::optional<T> number_in(std::string_view word) {
  T value{};
  const auto [end, error] = number_from_text(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() ? std::optional(value)
                                                                  : std::nullopt;
}

/// One <mesh>: the contents of its arrays, and all other attributes.
struct MeshElement {
  Words points;
  Words faces;
  Words places;
  std::string name;
  std::string others;  ///< with a space before each
  bool has_more = false;
};

MeshElement mesh_in(std::string_view element) {
  MeshElement mesh;
  for (std::size_t at = element.find('"'); at != std::string_view::npos;
       at = element.find('"', at + 1)) {
    const std::size_t end = element.find('"', at + 1);
    const std::size_t begin = element.rfind(' ', at) + 1;
    if (end == std::string_view::npos) {
      break;
    }
    const std::string_view key = element.substr(begin, at - 1 - begin);
    const std::string_view value = element.substr(at + 1, end - at - 1);
    if (key == "vertex") {
      mesh.points = words_of(value);
    } else if (key == "face") {
      mesh.faces = words_of(value);
    } else if (key == "texcoord") {
      mesh.places = words_of(value);
    } else {
      mesh.name = key == "name" ? std::string(value) : mesh.name;
      mesh.has_more |= key == "normal" || key == "facenormal" || key == "facetexcoord" ||
                       key == "file" || key == "builtin";
      mesh.others += " " + std::string(element.substr(begin, end + 1 - begin));
    }
    at = end;
  }
  return mesh;
}

std::string point_lines(const Words& numbers) {
  std::string text;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    text += "v " + std::string(numbers[i]) + " " + std::string(numbers[i + 1]) + " " +
            std::string(numbers[i + 2]) + "\n";
  }
  return text;
}

std::optional<std::string> with_faces(const MeshElement& mesh) {
  std::string text = point_lines(mesh.points);
  const bool has_places = !mesh.places.empty();
  for (std::size_t i = 0; i + 1 < mesh.places.size(); i += 2) {
    const auto down = number_in<double>(mesh.places[i + 1]);
    if (!down) {
      return std::nullopt;
    }
    text +=
        "vt " + std::string(mesh.places[i]) + " " + shortest(static_cast<float>(1 - *down)) + "\n";
  }
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto corner = number_in<int>(mesh.faces[i]);
    if (!corner) {
      return std::nullopt;
    }
    const std::string number = std::to_string(*corner + 1);
    text += (i % 3 == 0 ? "f " : " ") + number + (has_places ? "/" + number : std::string()) +
            (i % 3 == 2 ? "\n" : "");
  }
  return text;
}

/// None for points without a volume.
std::optional<std::string> hull_text(const MeshElement& mesh) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i + 2 < mesh.points.size(); i += 3) {
    Vec3d point;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto number = number_in<double>(mesh.points[i + k]);
      if (!number) {
        return std::nullopt;
      }
      point[k] = *number;
    }
    points.push_back(point);
  }
  const scene::TriangleMesh hull = scene::convex_hull(points);
  if (hull.triangles.empty()) {
    return std::nullopt;
  }
  std::vector<Vec3f> corners;
  corners.reserve(hull.points.size());
  for (const Vec3d& point : hull.points) {
    corners.push_back(to_float(point));
  }
  return obj_text(corners, hull.triangles);
}

/// Plain letters of a name, so that it may be a file's.
std::string file_stem(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    const bool ok = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    plain += ok || c == '-' ? c : '_';
  }
  constexpr std::size_t kLongest = 100;
  return plain.empty() ? "mesh" : plain.substr(0, kLongest);
}

}  // namespace

std::string with_mesh_files(const std::string& text, const std::string& folder,
                            std::map<std::string, std::string>& files) {
  std::string out;
  std::size_t at = 0;
  std::map<std::string, std::string> known;  // names by contents
  constexpr std::string_view kMesh = "<mesh ";
  for (std::size_t begin = text.find(kMesh); begin != std::string::npos;
       begin = text.find(kMesh, at)) {
    const std::size_t end = std::min(text.find('>', begin), text.size());
    const MeshElement mesh = mesh_in(std::string_view(text).substr(begin, end - begin));
    out += text.substr(at, begin - at);
    at = end;
    const bool is_array = !mesh.points.empty() && !mesh.has_more;
    auto contents = !is_array            ? std::optional<std::string>()
                    : mesh.faces.empty() ? hull_text(mesh)
                                         : with_faces(mesh);
    if (!contents) {
      out += text.substr(begin, end - begin);
      continue;
    }
    std::string place = folder + "/" + file_stem(mesh.name) + ".obj";
    for (int i = 2; files.contains(place); ++i) {
      place = folder + "/" + file_stem(mesh.name) + "_" + std::to_string(i) + ".obj";
    }
    const auto [known_at, is_new] = known.emplace(*contents, place);
    if (is_new) {
      files.emplace(place, *std::move(contents));
    }
    out += std::string(kMesh.substr(0, kMesh.size() - 1)) + mesh.others + " file=\"" +
           known_at->second + "\"/";
  }
  return out + text.substr(at);
}

}  // namespace tenon
