// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/source/record.h"

#include <filesystem>

#include "tenon/base/file_finding.h"
#include "tenon/base/text/unicode.h"
#include "tenon/bytes/file_kind.h"
#include "tenon/convert/source/seal.h"

namespace tenon::convert {
namespace {

using layer::Value;
namespace fields = layer::fields;

void add_custom(layer::Layer& layer, Path prim, Token name, const char* type, Value value) {
  layer::Spec& owner = layer.create(prim, layer::SpecKind::Prim);
  std::vector<Token> names = layer::Layer::children(owner, fields::properties);
  names.push_back(name);
  owner.set(fields::properties, Value(std::move(names)));
  layer::Spec& spec = layer.create(prim.property(name), layer::SpecKind::Attribute);
  spec.set(fields::custom, Value(true));
  spec.set(fields::typeName, Value(Token(type)));
  spec.set(fields::variability, Value(layer::Variability::Uniform));
  spec.set(fields::default_value, std::move(value));
}

/// Why a file of the source cannot come along; empty: it can.
std::string why_not_kept(const std::string& file, const bytes::ReadPolicy& reading) {
  if (!unicode::is_printable(std::filesystem::path(file).filename().string())) {
    return bytes::not_nameable(file).message();
  }
  const auto contents = reading.open(file);
  if (!contents) {
    return contents.error().message();
  }
  const bytes::FileKind kind = bytes::kind_of((*contents)->text());
  return kind == bytes::FileKind::Image || kind == bytes::FileKind::Shape
             ? ""
             : bytes::not_media(file).message();
}

bool asks_for_another(const ConvertOptions& options) {
  return options.merge_fixed || options.float_base || options.fix_base || options.gains ||
         options.self_collision || options.density || !options.joint_gains.empty() ||
         !options.armature.empty() || !options.friction.empty() || !options.collision.empty();
}

}  // namespace

void write_source(const robot::RobotModel& model, const ConvertOptions& options,
                  layer::Layer& layer, Diagnostics& diagnostics) {
  const robot::MujocoSource& source = model.mujoco.source;
  if (source.text.empty() || asks_for_another(options)) {
    return;
  }
  for (const std::string& file : source.files) {
    if (const std::string why = why_not_kept(file, options.reading); !why.empty()) {
      diagnostics.add(file_finding(Severity::Info, "mjcf.source",
                                   "what MJCF alone has is not kept for the way back: " + why,
                                   model.file, 0));
      return;
    }
  }
  const Path robot = Path::absolute_root().child(layer.default_prim());
  SealParts parts;
  std::vector<std::string> words = seal_words(seal_of(layer, &parts));
  add_custom(layer, robot, kSourceText, "string", Value(source.text));
  add_custom(layer, robot, kSourceSeal, "string[]", Value(layer::Array<std::string>(words)));
  add_custom(layer, robot, kSourceParts, "string[]",
             Value(layer::Array<std::string>(part_words(parts))));
  for (std::size_t i = 0; i < source.files.size(); ++i) {
    add_custom(layer, robot, Token(kSourceFile + std::to_string(i)), "asset",
               Value(layer::AssetPath{source.files[i], "", ""}));
  }
}

}  // namespace tenon::convert
