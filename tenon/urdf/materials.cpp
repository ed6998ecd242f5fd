// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A material is defined below <robot> or inside a visual; a visual may also name one that is
// defined anywhere. Two definitions of one name that differ stay two. A colour that is none costs
// the colour, not the robot.
#include "tenon/base/text/text_number.h"
#include "tenon/urdf/urdf_reader.h"

namespace tenon::urdf {
namespace {

bool says_something(const robot::Material& material) {
  return material.color || !material.texture.empty();
}

/// None for what is no colour, which is reported.
Result<std::optional<Vec4d>> read_color(XmlReader& xml, pugi::xml_node color) {
  xml.list_unknown(color, {"rgba"}, {});
  const Result<std::vector<double>> rgba = xml.numbers(color, "rgba", 4, {});
  if (!rgba && rgba.error().diagnostic().rule == "urdf.xacro") {
    return rgba.error();
  }
  if (!rgba) {
    const std::string written = color.attribute("rgba").value();
    xml.warn(color, "urdf.color",
             "rgba=\"" + written + "\" is not 4 numbers; the material has no colour",
             "write rgba=\"red green blue opacity\", each from 0 to 1", Severity::Warning,
             written.empty() ? "" : "rgba");
    return std::optional<Vec4d>();
  }
  Vec4d values{{(*rgba)[0], (*rgba)[1], (*rgba)[2], (*rgba)[3]}};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(values[i] >= 0 && values[i] <= 1)) {
      xml.warn(color, "urdf.color", "rgba has a number outside of 0 to 1; the nearest is used",
               "divide colours of 0 to 255 by 255");
      values[i] = values[i] > 1 ? 1 : 0;
    }
  }
  return std::optional<Vec4d>(values);
}

}  // namespace

Result<robot::Material> UrdfReader::read_material(pugi::xml_node element) {
  xml_.list_unknown(element, {"name"}, {"color", "texture"});
  robot::Material material;
  material.name = element.attribute("name").value();
  material.place = xml_.place_of(element);
  if (const pugi::xml_node color = element.child("color")) {
    TENON_TRY(material.color, read_color(xml_, color));
    if (!material.color) {
      colorless_.insert(material.name);
    }
  }
  if (const pugi::xml_node texture = element.child("texture")) {
    xml_.list_unknown(texture, {"filename"}, {});
    const std::string written = texture.attribute("filename").value();
    const Result<std::string> file = written.empty() ? std::string() : paths_.find(written);
    if (written.empty()) {
      xml_.warn(texture, "urdf.missing", "names no file; it is skipped", "write filename=\"...\"");
    } else if (!file && !file.error().diagnostic().rule.empty()) {
      const Diagnostic& why = file.error().diagnostic();
      xml_.warn(texture, why.rule.c_str(), "the texture " + why.message + "; it is skipped",
                why.fix, Severity::Error);
    } else if (!file) {
      xml_.warn(texture, "urdf.texture-missing",
                "the texture \"" + written + "\" cannot be found; it is skipped",
                paths_.advice(written), Severity::Error);
    }
    if (file && paths_.is_guess(written)) {
      report_guess(xml_, texture, "the texture \"" + written + "\"", *file, paths_.advice(written));
    }
    material.texture = file.value_or("");
  }
  return material;
}

robot::Index UrdfReader::material_number(robot::Material material) {
  std::string key = material.name + '\n' + material.texture;
  for (std::size_t i = 0; material.color && i < 4; ++i) {
    key += '\n' + shortest((*material.color)[i]);
  }
  const auto number = static_cast<robot::Index>(model_.materials.size());
  const auto [at, is_new] = material_numbers_.emplace(std::move(key), number);
  if (is_new) {
    first_material_.emplace(material.name, number);
    model_.materials.push_back(std::move(material));
  }
  return at->second;
}

void UrdfReader::find_material_definitions(pugi::xml_node robot) {
  for (const pugi::xml_node link : robot.children("link")) {
    for (const pugi::xml_node visual : link.children("visual")) {
      const pugi::xml_node material = visual.child("material");
      if (material.child("color") || material.child("texture")) {
        definitions_.emplace(material.attribute("name").value(), material);
      }
    }
  }
}

Result<void> UrdfReader::read_global_material(pugi::xml_node element) {
  TENON_TRY(robot::Material material, read_material(element));
  TENON_CHECK(xml_.text(element, "name"));
  if (says_something(material)) {
    material_number(std::move(material));
  }
  return {};
}

Result<std::optional<robot::Index>> UrdfReader::read_material_of(pugi::xml_node shape) {
  const pugi::xml_node element = shape.child("material");
  if (!element) {
    return std::optional<robot::Index>();
  }
  TENON_TRY(robot::Material material, read_material(element));
  if (says_something(material)) {
    return std::optional<robot::Index>(material_number(std::move(material)));
  }
  if (const auto known = first_material_.find(material.name); known != first_material_.end()) {
    return std::optional<robot::Index>(known->second);
  }
  if (const auto later = definitions_.find(material.name); later != definitions_.end()) {
    TENON_TRY(robot::Material defined, read_material(later->second));
    return std::optional<robot::Index>(material_number(std::move(defined)));
  }
  if (!material.name.empty() && colorless_.count(material.name) == 0) {
    xml_.warn(element, "urdf.material-missing",
              "no material \"" + material.name + "\" is defined; the shape has none",
              "define it below <robot>");
  }
  return std::optional<robot::Index>();
}

}  // namespace tenon::urdf
