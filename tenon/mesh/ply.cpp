// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PLY (Turk, 1994): a text header that names elements and the types of their properties, then the
// elements in that order, as words or as bytes of either order. Points are the properties x, y and
// z of "vertex", faces the list vertex_indices (or vertex_index) of "face"; all else is skipped by
// its type. Every count is checked against the remaining bytes before memory is allocated.
#include <algorithm>
#include <bit>

#include "tenon/base/limits/limits.h"
#include "tenon/mesh/read_mesh.h"
#include "tenon/mesh/text_scanner.h"

namespace tenon::mesh {
namespace {

enum class PlyForm : std::uint8_t { Text, LittleEndian, BigEndian };

struct PlyType {
  unsigned bytes = 0;
  char kind = 'i';  ///< i: signed, u: unsigned, f: floating point
};

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

std::optional<PlyType> type_named(std::string_view name) {
  struct Row {
    std::string_view name;
    PlyType type;
  };
  constexpr Row kRows[] = {
      {"char", {1, 'i'}},  {"int8", {1, 'i'}},    {"uchar", {1, 'u'}},  {"uint8", {1, 'u'}},
      {"short", {2, 'i'}}, {"int16", {2, 'i'}},   {"ushort", {2, 'u'}}, {"uint16", {2, 'u'}},
      {"int", {4, 'i'}},   {"int32", {4, 'i'}},   {"uint", {4, 'u'}},   {"uint32", {4, 'u'}},
      {"float", {4, 'f'}}, {"float32", {4, 'f'}}, {"double", {8, 'f'}}, {"float64", {8, 'f'}}};
  for (const Row& row : kRows) {
    if (row.name == name) {
      return row.type;
    }
  }
  return std::nullopt;
}

Error ply_fault(const std::string& path, std::string message) {
  return Error(ErrorCode::Corrupt, std::move(message))
      .in_file(path)
      .with_rule("mesh.ply")
      .with_fix("export the mesh again");
}

/// The numbers of the body one after another, whatever their form.
class PlyNumbers {
 public:
  PlyNumbers(std::string_view body, PlyForm form) : body_(body), form_(form) {}

  /// Nothing at the end, and for what is no number.
  std::optional<double> next(PlyType type) {
    return form_ == PlyForm::Text ? next_word() : next_bytes(type);
  }

  /// Each number takes at least one byte.
  std::size_t left() const { return body_.size() - at_; }

 private:
  std::optional<double> next_word() {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::size_t begin = body_.find_first_not_of(kSpace, at_);
    if (begin == body_.npos) {
      return std::nullopt;
    }
    at_ = std::min(body_.find_first_of(kSpace, begin), body_.size());
    return number_of<double>(body_.substr(begin, at_ - begin));
  }

  std::optional<double> next_bytes(PlyType type) {
    if (left() < type.bytes) {
      return std::nullopt;
    }
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < type.bytes; ++i) {
      const unsigned place = form_ == PlyForm::LittleEndian ? i : type.bytes - 1 - i;
      const auto byte = static_cast<unsigned char>(body_[at_ + i]);
      bits |= static_cast<std::uint64_t>(byte) << (8 * place);
    }
    at_ += type.bytes;
    if (type.kind == 'f') {
      return type.bytes == 4
                 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                 : std::bit_cast<double>(bits);
    }
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
    const bool negative = type.kind == 'i' && (bits & sign) != 0;
    return static_cast<double>(bits) - (negative ? 2 * static_cast<double>(sign) : 0);
  }

  std::string_view body_;
  PlyForm form_;
  std::size_t at_ = 0;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  Result<MeshScene> run() {
    TENON_CHECK(read_header());
    PlyNumbers numbers(bytes_.substr(body_), form_);
    for (const PlyElement& element : elements_) {
      if (element.count > numbers.left()) {
        return ply_fault(path_, "the file counts " + std::to_string(element.count) + " of \"" +
                                    element.name + "\" and is too short for them");
      }
      for (std::uint64_t i = 0; i < element.count; ++i) {
        TENON_CHECK(read_element(element, numbers));
      }
    }
    for (const std::int32_t point : mesh_.face_points) {
      if (point < 0 || static_cast<std::size_t>(point) >= mesh_.points.size()) {
        return ply_fault(path_, "a face names a point that is not there");
      }
    }
    if (mesh_.face_counts.empty()) {
      return ply_fault(path_, "the file has no faces");
    }
    MeshScene scene;
    scene.meshes.push_back(std::move(mesh_));
    return scene;
  }

 private:
  Result<void> read_header() {
    constexpr std::size_t kHeaderBytes = 65536;
    constexpr std::string_view kEnd = "end_header";
    const std::size_t end = bytes_.substr(0, kHeaderBytes).find(kEnd);
    const std::size_t line = end == bytes_.npos ? end : bytes_.find('\n', end);
    if (!bytes_.starts_with("ply") || line == bytes_.npos) {
      return ply_fault(path_, "the file has no header of a PLY");
    }
    body_ = line + 1;
    TextScanner scanner(bytes_.substr(0, end));
    while (scanner.next_line()) {
      const std::string_view word = scanner.word();
      if (word == "format") {
        const std::string_view form = scanner.word();
        form_ = form == "ascii"                  ? PlyForm::Text
                : form == "binary_little_endian" ? PlyForm::LittleEndian
                                                 : PlyForm::BigEndian;
      } else if (word == "element") {
        PlyElement& element = elements_.emplace_back();
        element.name = scanner.word();
        element.count = number_of<std::uint64_t>(scanner.word()).value_or(0);
      } else if (word == "property") {
        TENON_CHECK(read_property(scanner));
      }
    }
    return {};
  }

  Result<void> read_property(TextScanner& scanner) {
    PlyProperty property;
    std::string_view type = scanner.word();
    bool known = !elements_.empty();
    if (type == "list") {
      property.count = type_named(scanner.word());
      known = known && property.count.has_value();
      type = scanner.word();
    }
    const std::optional<PlyType> found = type_named(type);
    property.name = scanner.word();
    if (!known || !found) {
      return ply_fault(path_, "the property \"" + property.name + "\" has no type of a PLY");
    }
    property.type = *found;
    elements_.back().properties.push_back(std::move(property));
    return {};
  }

  Error too_short() const {
    return ply_fault(path_, "the file ends too early, or holds no number");
  }

  Result<void> read_element(const PlyElement& element, PlyNumbers& numbers) {
    const bool is_vertex = element.name == "vertex";
    Vec3f point;
    for (const PlyProperty& property : element.properties) {
      if (property.count) {
        const bool is_face = element.name == "face" &&
                             (property.name == "vertex_indices" || property.name == "vertex_index");
        TENON_CHECK(read_list(property, is_face, numbers));
        continue;
      }
      const std::optional<double> number = numbers.next(property.type);
      if (!number) {
        return too_short();
      }
      const std::size_t axis = property.name.size() == 1 ? property.name[0] - 'x' : 3;
      if (is_vertex && axis < 3) {
        point[axis] = static_cast<float>(*number);
      }
    }
    if (is_vertex) {
      if (!is_finite(point)) {
        return ply_fault(path_, "a point has a coordinate that is not a finite number");
      }
      mesh_.points.push_back(point);
    }
    return {};
  }

  Result<void> read_list(const PlyProperty& property, bool is_face, PlyNumbers& numbers) {
    const std::optional<double> count = numbers.next(*property.count);
    if (!count || !(*count >= 0) || *count > static_cast<double>(numbers.left())) {
      return too_short();
    }
    const auto corners = static_cast<std::size_t>(*count);
    const bool keep = is_face && corners >= 3;  // fewer show nothing
    if (keep && mesh_.face_points.size() + corners > limits::kMeshCorners) {
      return Error(ErrorCode::Limit, "more corners than a mesh may have")
          .in_file(path_)
          .with_rule("mesh.ply");
    }
    for (std::size_t i = 0; i < corners; ++i) {
      const std::optional<double> number = numbers.next(property.type);
      if (!number) {
        return too_short();
      }
      if (keep) {
        const bool whole = *number >= 0 && *number < 2147483648.0;
        mesh_.face_points.push_back(whole ? static_cast<std::int32_t>(*number) : -1);
      }
    }
    if (keep) {
      mesh_.face_counts.push_back(static_cast<std::int32_t>(corners));
    }
    return {};
  }

  std::string_view bytes_;
  const std::string& path_;
  PlyForm form_ = PlyForm::Text;
  std::size_t body_ = 0;
  std::vector<PlyElement> elements_;
  PolygonMesh mesh_;
};

}  // namespace

Result<MeshScene> read_ply(std::string_view bytes, const std::string& path) {
  return PlyReader(bytes, path).run();
}

}  // namespace tenon::mesh
