// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The model that is read for USD is compiled whole. A model that asks MuJoCo to fuse bodies or to
// drop visuals is compiled once more as it asks, for its text to be that of the model that MuJoCo
// makes of the file. Folders of files are removed from the text, as the files come along. MuJoCo
// writes only the sizes that a shape uses, and reads another size then; sizes are whole here.
#include "tenon/mjcf/keep_source.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "tenon/base/text/text_number.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/writable_model.h"
#include "tenon/mjcf/text/plain_actuators.h"
#include "tenon/mjcf/text/walk_text.h"

namespace tenon::mjcf {
namespace {

namespace fs = std::filesystem;
using engines::mujoco::ModelPtr;

/// nullptr: MuJoCo refuses it.
ModelPtr compile_as_asked(mjSpec& spec, const Simplified& simplified) {
  spec.compiler.fusestatic = static_cast<mjtByte>(simplified.fuses_static);
  spec.compiler.discardvisual = static_cast<mjtByte>(simplified.drops_visuals);
  mjModel* model = nullptr;
  const WithoutArena small(spec);
  const auto compiled = engines::mujoco::guarded([&] { model = mj_compile(&spec, nullptr); });
  return compiled ? ModelPtr(model) : nullptr;
}

/// Long decimals as the shortest that read back as the same number.
std::string with_short_numbers(std::string_view value) {
  constexpr std::size_t kLong = 12;
  std::string out;
  for (std::size_t at = 0; at < value.size();) {
    const std::size_t end = std::min(value.find(' ', at), value.size());
    const std::string_view word = value.substr(at, end - at);
    const auto number = word.size() < kLong ? std::nullopt : parse_double(word);
    out += number ? layer_text(*number) : std::string(word);
    at = std::min(value.find_first_not_of(' ', end), value.size());
    out += value.substr(end, at - end);
  }
  return out;
}

class SourceFiles {
 public:
  SourceFiles(MjcfSource& source, mjSpec& spec)
      : folder_(fs::path(source.file()).parent_path()),
        meshes_(mjs_getString(spec.compiler.meshdir)),
        textures_(mjs_getString(spec.compiler.texturedir)) {}

  /// The placeholder of a file in the text.
  std::string mark_of(std::string_view tag, std::string_view file) {
    const fs::path name(file);
    std::error_code error;
    for (const fs::path& start : {folder_ / (tag == "texture" ? textures_ : meshes_), folder_}) {
      const fs::path found = fs::absolute(start / name, error).lexically_normal();
      if (fs::is_regular_file(found, error)) {
        const auto [at, is_new] = numbers_.try_emplace(found.generic_string(), files_.size());
        if (is_new) {
          files_.push_back(at->first);
        }
        return robot::MujocoSource::kFileMark + std::to_string(at->second);
      }
    }
    missing_ = missing_.empty() ? std::string(file) : missing_;
    return std::string(file);
  }

  const std::string& missing() const { return missing_; }
  std::vector<std::string> take() { return std::move(files_); }

 private:
  fs::path folder_;
  fs::path meshes_;
  fs::path textures_;
  std::vector<std::string> files_;
  std::map<std::string, std::size_t> numbers_;  // by file
  std::string missing_;
};

bool names_file(std::string_view section, std::string_view tag, std::string_view attribute) {
  const bool holds_files = section == "asset" || section == "deformable";
  return holds_files && attribute.starts_with("file") && tag != "material";
}

/// Gives sites and round geoms all three numbers of their sizes, as the model has them.
class SizeWriter {
 public:
  explicit SizeWriter(const mjModel& model)
      : model_(model),
        geoms_(numbers_by_body(model.geom_bodyid, model.ngeom, model.nbody)),
        sites_(numbers_by_body(model.site_bodyid, model.nsite, model.nbody)) {}

  std::string run(std::string_view text) {
    std::string out;
    std::size_t at = text.find("<worldbody");
    const std::size_t end = std::min(text.find("</worldbody>"), text.size());
    out += text.substr(0, std::min(at, end));
    while (at < end) {
      const std::size_t close = std::min(text.find('>', at), end - 1) + 1;
      const std::size_t next = std::min(text.find('<', close), end);
      out += element(text.substr(at, close - at));
      out += text.substr(close, next - close);
      at = next;
    }
    return out + std::string(text.substr(end));
  }

 private:
  using Numbers = std::vector<std::vector<int>>;  // by body, the first at the back

  static Numbers numbers_by_body(const int* body_of, mjtSize count, mjtSize bodies) {
    Numbers numbers(static_cast<std::size_t>(bodies));
    for (auto i = static_cast<int>(count); i-- > 0;) {
      numbers[static_cast<std::size_t>(body_of[i])].push_back(i);
    }
    return numbers;
  }

  std::string element(std::string_view tag) {
    const bool closed = tag.ends_with("/>");
    if (tag.starts_with("<body") || tag.starts_with("<worldbody")) {
      if (!closed) {
        bodies_.push_back(count_);
      }
      ++count_;
    } else if (tag.starts_with("</body")) {
      bodies_.pop_back();
    } else if (!bodies_.empty() && bodies_.back() < geoms_.size()) {
      return shape(tag, bodies_.back());
    }
    return std::string(tag);
  }

  std::string shape(std::string_view tag, std::size_t body) {
    const bool site = tag.starts_with("<site");
    std::vector<int>& left = site ? sites_[body] : geoms_[body];
    if ((!site && !tag.starts_with("<geom")) || left.empty()) {
      return std::string(tag);
    }
    const int number = left.back();
    left.pop_back();
    return site ? with_size(tag, model_.site_size + 3 * static_cast<std::size_t>(number))
                : geom(tag, number);
  }

  std::string geom(std::string_view tag, int geom) const {
    const double* size = model_.geom_size + 3 * static_cast<std::size_t>(geom);
    const int type = model_.geom_type[geom];
    const bool spare = (type == mjGEOM_SPHERE && (size[1] != 0 || size[2] != 0)) ||
                       ((type == mjGEOM_CAPSULE || type == mjGEOM_CYLINDER) && size[2] != 0);
    return spare ? with_size(tag, size) : std::string(tag);
  }

  static std::string with_size(std::string_view tag, const double* size) {
    const std::string whole = " size=\"" + layer_text(size[0]) + " " + layer_text(size[1]) + " " +
                              layer_text(size[2]) + "\"";
    std::string out(tag);
    const std::size_t at = out.find(" size=\"");
    if (at == std::string::npos) {
      return out.insert(out.find_first_of(" />", 1), whole);
    }
    return out.replace(at, out.find('"', at + 7) + 1 - at, whole);
  }

  const mjModel& model_;
  Numbers geoms_;  // that are still to come
  Numbers sites_;
  std::vector<std::size_t> bodies_;  // that are open
  std::size_t count_ = 0;
};

/// Without an attribute of the compiler that is about where files lie.
void drop_folder(std::string& text, std::string_view attribute) {
  const std::size_t compiler = text.find("<compiler");
  const std::size_t end = text.find('>', compiler);
  const std::size_t at = text.find(" " + std::string(attribute) + "=\"", compiler);
  if (compiler != std::string::npos && at < end) {
    const std::size_t quote = text.find('"', text.find('"', at) + 1);
    text.erase(at, quote + 1 - at);
  }
}

/// The text with the room that simulations are to have, which the compiler was not told of
/// (WithoutArena).
std::string with_arena(std::string text, const mjSpec& spec) {
  std::string room;
  const auto add = [&](const char* name, long long value) {
    if (value != -1) {
      room += std::string(" ") + name + "=\"" + std::to_string(value) + "\"";
    }
  };
  add("memory", spec.memory);
  add("njmax", spec.njmax);
  add("nconmax", spec.nconmax);
  constexpr std::string_view kSize = "<size";
  const std::size_t size = text.find(kSize);
  const std::size_t start = text.find('>', text.find("<mujoco"));
  if (room.empty() || start == std::string::npos || text[start - 1] == '/') {
    return text;
  }
  return size == std::string::npos ? text.insert(start + 1, "\n  <size" + room + "/>")
                                   : text.insert(size + kSize.size(), room);
}

}  // namespace

robot::MujocoSource keep_source(MjcfSource& source, mjSpec& spec, const Simplified& simplified) {
  ModelPtr again;
  if (simplified.fuses_static || simplified.drops_visuals) {
    again = compile_as_asked(spec, simplified);
    if (again == nullptr) {
      return {};
    }
  }
  const auto text = engines::mujoco::text_of(spec);
  if (!text) {
    source.report(Severity::Info, "mjcf.source",
                  "what MJCF alone has is not kept for the way back: " + text.error().message());
    return {};
  }
  SourceFiles files(source, spec);
  const std::string whole = with_arena(*text, spec);
  const std::string sized = SizeWriter(again ? *again : source.model()).run(whole);
  robot::MujocoSource kept;
  kept.text = walk_text(sized, [&](auto section, auto tag, auto attribute, auto value) {
    return names_file(section, tag, attribute) ? files.mark_of(tag, value)
                                               : with_short_numbers(value);
  });
  if (!files.missing().empty()) {
    source.report(Severity::Info, "mjcf.source",
                  "what MJCF alone has is not kept for the way back: the file \"" +
                      files.missing() + "\" is not found");
    return {};
  }
  kept.text = plain_actuators(kept.text);
  for (const char* folder : {"meshdir", "texturedir", "assetdir", "strippath"}) {
    drop_folder(kept.text, folder);
  }
  kept.files = files.take();
  return kept;
}

}  // namespace tenon::mjcf
