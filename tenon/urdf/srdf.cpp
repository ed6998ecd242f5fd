// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/urdf/srdf.h"

#include <utility>

#include "tenon/base/limits/pair_limits.h"
#include "tenon/base/text/xml_text.h"
#include "tenon/urdf/xml_reader.h"

namespace tenon::urdf {
namespace {

/// The error of broken XML, in words of this format.
Error not_xml(const Error& error) {
  Diagnostic finding = error.diagnostic();
  if (finding.rule == "urdf.xml") {
    finding.rule = "srdf.xml";
  }
  const std::size_t why = finding.message.find("it is not valid XML");
  if (why != std::string::npos) {
    finding.message = "no SRDF can be read from this, " + finding.message.substr(why);
  }
  return {error.code(), std::move(finding)};
}

Error wrong_root(const XmlReader& xml, pugi::xml_node root) {
  const robot::Place at = xml.place_of(root);
  return Error(ErrorCode::Unsupported,
               "the root element is <" + std::string(root.name()) + ">, not <robot>")
      .in_file(xml.file())
      .at(at.line, at.column)
      .with_rule("srdf.root")
      .with_fix("give an SRDF, as MoveIt's setup assistant writes it");
}

Error too_many(const XmlReader& xml, pugi::xml_node node) {
  const robot::Place at = xml.place_of(node);
  return Error(ErrorCode::Limit, "more than " + std::to_string(limits::kListedPairs) +
                                     " pairs of links (kListedPairs)")
      .in_file(xml.file())
      .at(at.line, at.column)
      .with_rule("pairs.too-many");
}

}  // namespace

Result<std::vector<DisabledCollision>> read_srdf_text(std::string_view text,
                                                      const std::string& path,
                                                      Diagnostics& diagnostics) {
  XmlReader xml(text, path, diagnostics);
  const auto root = xml.parse();
  if (!root) {
    return not_xml(root.error());
  }
  if (std::string_view(root->name()) != "robot") {
    return wrong_root(xml, *root);
  }
  std::vector<DisabledCollision> pairs;
  for (const pugi::xml_node node : root->children("disable_collisions")) {
    if (pairs.size() == limits::kListedPairs) {
      return too_many(xml, node);
    }
    DisabledCollision pair;
    TENON_TRY(pair.link1, xml.text(node, "link1"));
    TENON_TRY(pair.link2, xml.text(node, "link2"));
    pair.reason = node.attribute("reason").value();
    pair.place = xml.place_of(node);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

Result<std::vector<DisabledCollision>> read_srdf(const std::string& path, const bytes::Files& files,
                                                 Diagnostics& diagnostics) {
  bytes::FileRules rules;
  rules.max_bytes = limits::kPairFileBytes;
  TENON_TRY(const auto contents, files->open(path, rules));
  return read_srdf_text(contents->text(), path, diagnostics);
}

std::string write_srdf(const std::string& robot, const std::vector<DisabledCollision>& pairs) {
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"" + xml_text(robot) + "\">\n";
  for (const DisabledCollision& pair : pairs) {
    text += "  <disable_collisions link1=\"" + xml_text(pair.link1) + "\" link2=\"" +
            xml_text(pair.link2) + "\" reason=\"" + xml_text(pair.reason) + "\"/>\n";
  }
  return text + "</robot>\n";
}

}  // namespace tenon::urdf
