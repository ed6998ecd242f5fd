// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/base/text/shell_word.h"
#include "tenon/sdf/model_tree.h"

namespace tenon::sdf {
namespace {

struct Candidate {
  std::string name;
  pugi::xml_node element;
  pugi::xml_node world;
};

/// Of an <include> without a name: the last part of what it includes, as folders of models are
/// called.
std::string name_of_include(pugi::xml_node include) {
  std::string name = SdfFile::text_of(include.child("name"));
  if (!name.empty()) {
    return name;
  }
  name = SdfFile::text_of(include.child("uri"));
  while (!name.empty() && name.back() == '/') {
    name.pop_back();
  }
  return name.substr(name.find_last_of('/') + 1);
}

void add_candidates(pugi::xml_node holder, pugi::xml_node world, std::vector<Candidate>& list) {
  for (const pugi::xml_node child : holder.children()) {
    const std::string_view kind = child.name();
    if (kind == "model") {
      list.push_back({child.attribute("name").value(), child, world});
    } else if (kind == "include") {
      list.push_back({name_of_include(child), child, world});
    }
  }
}

std::string names_of(const std::vector<Candidate>& list) {
  constexpr std::size_t kNamed = 20;
  std::string names;
  for (std::size_t i = 0; i < std::min(list.size(), kNamed); ++i) {
    names += (i == 0 ? "\"" : ", \"") + list[i].name + "\"";
  }
  return names + (list.size() > kNamed ? " and more" : "");
}

Error choice_error(const SdfFile& file, ErrorCode code, std::string message, std::string fix) {
  return Error(code, std::move(message))
      .in_file(file.path())
      .with_rule("sdf.model")
      .with_fix(std::move(fix));
}

}  // namespace

Result<ChosenModel> choose_model(SdfFile& file, const std::string& name) {
  std::vector<Candidate> list;
  add_candidates(file.root(), {}, list);
  for (const pugi::xml_node world : file.root().children("world")) {
    add_candidates(world, world, list);
  }
  if (list.empty()) {
    return choice_error(file, ErrorCode::NotFound, "the file has no model",
                        "give a file with a <model>");
  }
  auto chosen = list.begin();
  if (!name.empty()) {
    chosen = std::find_if(list.begin(), list.end(),
                          [&](const Candidate& one) { return one.name == name; });
    if (chosen == list.end()) {
      return choice_error(
          file, ErrorCode::NotFound,
          "no model of the file is named \"" + name + "\": it has " + names_of(list),
          "name one of them: --model " + shell_word(list.front().name));
    }
  } else if (list.size() > 1) {
    return choice_error(
        file, ErrorCode::Invalid,
        "the file has " + std::to_string(list.size()) + " models: " + names_of(list),
        "say which one: --model " + shell_word(list.front().name));
  }
  return ChosenModel{&file, chosen->element, &file, chosen->world};
}

}  // namespace tenon::sdf
