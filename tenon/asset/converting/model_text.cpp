// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The text is read once, with its white space, and named elements are kept in a table. Defaults are
// looked up as MuJoCo does: the class of the element, or that which a body around it gives its
// children, then the classes around that one.
#include "tenon/asset/converting/model_text.h"

#include <algorithm>
#include <sstream>

#include "tenon/base/text/source_number.h"
#include "tenon/base/text/text_number.h"

namespace tenon {
namespace {

pugi::xml_node next_element(pugi::xml_node node, pugi::xml_node top) {
  if (node.first_child()) {
    return node.first_child();
  }
  while (node != top && !node.next_sibling()) {
    node = node.parent();
  }
  return node == top ? pugi::xml_node() : node.next_sibling();
}

/// What a class says of actuators, in the words of <general>: one of a class is of all kinds.
std::string actuator_default(pugi::xml_node group, std::string_view attribute) {
  const auto number = [](pugi::xml_node node, const char* name, const char* otherwise) {
    return std::string(node.attribute(name).as_string(otherwise));
  };
  for (const pugi::xml_node node : group.children()) {
    const std::string_view tag = node.name();
    const bool position = tag == "position";
    if (position || tag == "velocity") {
      if (attribute == "biastype") {
        return "affine";
      }
      const std::string kv = number(node, "kv", position ? "0" : "1");
      if (attribute == "gainprm") {
        return position ? number(node, "kp", "1") : kv;
      }
      if (attribute == "biasprm") {
        return "0 " + (position ? "-" + number(node, "kp", "1") : "0") + " -" + kv;
      }
    }
    if (position || tag == "velocity" || tag == "general" || tag == "motor") {
      return node.attribute(std::string(attribute).c_str()).value();
    }
  }
  return {};
}

}  // namespace

Result<ModelText> ModelText::read(const std::string& text) {
  ModelText model;
  model.document_ = std::make_unique<pugi::xml_document>();
  const unsigned kept = pugi::parse_default | pugi::parse_comments | pugi::parse_ws_pcdata;
  if (!model.document_->load_buffer(text.data(), text.size(), kept)) {
    return Error(ErrorCode::Parse, "the kept model is not XML");
  }
  model.index();
  return model;
}

void ModelText::index() {
  const pugi::xml_node root = document_->document_element();
  for (const pugi::xml_node part : root.children()) {
    const std::string_view tag = part.name();
    if (tag != "worldbody" && tag != "actuator" && tag != "default") {
      continue;
    }
    if (tag == "default") {  // the main class; it may have any name
      classes_.emplace("", part);
    }
    for (pugi::xml_node node = part.first_child(); node; node = next_element(node, part)) {
      if (tag == "default" && std::string_view(node.name()) == "default") {
        classes_.emplace(node.attribute("class").value(), node);
      } else if (tag != "default" && node.attribute("name")) {
        named_[{tag == "actuator" ? "actuator" : node.name(), node.attribute("name").value()}]
            .push_back(node);
      }
    }
  }
}

pugi::xml_node ModelText::named(std::string_view kind, const std::string& name) const {
  const auto at = named_.find({std::string(kind), name});
  return at == named_.end() || at->second.size() != 1 ? pugi::xml_node() : at->second[0];
}

bool ModelText::is_spring(pugi::xml_node actuator) const {
  const std::string_view tag = actuator.name();
  if (tag == "position" || tag == "velocity") {
    return value(actuator, "timeconst").empty();
  }
  const std::string dynamics = value(actuator, "dyntype");
  const std::string gain = value(actuator, "gaintype");
  return tag == "general" && value(actuator, "biastype") == "affine" &&
         (gain.empty() || gain == "fixed") && (dynamics.empty() || dynamics == "none");
}

pugi::xml_node ModelText::spring_of(const std::string& joint) const {
  pugi::xml_node found;
  for (const pugi::xml_node node : document_->document_element().child("actuator").children()) {
    if (joint != node.attribute("joint").value()) {
      continue;
    }
    if (found || !is_spring(node)) {
      return {};
    }
    found = node;
  }
  return found;
}

pugi::xml_node ModelText::section(const char* tag) {
  pugi::xml_node root = document_->document_element();
  const pugi::xml_node known = root.child(tag);
  return known ? known : root.prepend_child(tag);
}

std::string ModelText::value(pugi::xml_node node, const char* attribute) const {
  if (const pugi::xml_attribute own = node.attribute(attribute)) {
    return own.value();
  }
  std::string name = node.attribute("class").value();
  for (pugi::xml_node around = node.parent(); name.empty() && around; around = around.parent()) {
    name = around.attribute("childclass").value();
  }
  const bool is_actuator = std::string_view(node.parent().name()) == "actuator";
  auto at = classes_.find(name);
  at = at == classes_.end() ? classes_.find("") : at;
  if (at == classes_.end()) {
    return {};
  }
  for (pugi::xml_node group = at->second; std::string_view(group.name()) == "default";
       group = group.parent()) {
    if (const std::string own = is_actuator ? actuator_default(group, attribute)
                                            : group.child(node.name()).attribute(attribute).value();
        !own.empty()) {
      return own;
    }
  }
  return {};
}

std::vector<double> ModelText::numbers(pugi::xml_node node, const char* attribute) const {
  std::istringstream words(value(node, attribute));
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    numbers.push_back(parse_double(word).value_or(0));
  }
  return numbers;
}

void ModelText::set(pugi::xml_node node, const char* attribute, const std::string& value) {
  pugi::xml_attribute known = node.attribute(attribute);
  known = known ? known : node.append_attribute(attribute);
  known.set_value(value.c_str());
}

void ModelText::set_numbers(pugi::xml_node node, const char* attribute,
                            const std::vector<double>& numbers,
                            const std::vector<double>& unset) const {
  std::vector<double> all = this->numbers(node, attribute);
  all = all.empty() ? unset : all;
  all.resize(std::max(all.size(), numbers.size()), 0);
  std::copy(numbers.begin(), numbers.end(), all.begin());
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += (i == 0 ? "" : " ") + source_number(all[i]);
  }
  set(node, attribute, text);
}

std::string ModelText::str() const {
  std::ostringstream out;
  document_->save(out, "", pugi::format_raw | pugi::format_no_declaration);
  return std::move(out).str() + "\n";
}

}  // namespace tenon
