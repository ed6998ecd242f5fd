// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Requirements on the asset as a whole: units, its root, its file's name and place, what its layers
// name, and what is said about it. Paths are judged as text: what a path on another machine may be
// is asked of the one that the asset has here.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>

#include "tenon/check/simready/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/math/transform.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/stage/stage_units.h"
#include "tenon/stage/transform_at.h"

namespace tenon::check::simready {
namespace {

namespace fs = std::filesystem;
namespace fields = layer::fields;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-';
  });
}

/// Names that Windows keeps for devices.
bool is_reserved(const std::string& name) {
  const std::string upper_name = upper(name);
  static const std::set<std::string> kDevices{"CON", "PRN", "AUX", "NUL"};
  const bool numbered = upper_name.size() == 4 &&
                        (upper_name.starts_with("COM") || upper_name.starts_with("LPT")) &&
                        upper_name[3] >= '1' && upper_name[3] <= '9';
  return numbered || kDevices.contains(upper_name);
}

bool is_usd_name(const std::string& name) {
  const std::string ending = lower(fs::path(name).extension().string());
  return ending == ".usd" || ending == ".usda" || ending == ".usdc" || ending == ".usdz";
}

bool is_absolute(const std::string& path) {
  return path.starts_with("/") || path.starts_with("\\\\") || (path.size() >= 2 && path[1] == ':');
}

const layer::Dictionary* dictionary_of(const layer::Value* value) {
  return value == nullptr ? nullptr : value->get<layer::Dictionary>();
}

const layer::Dictionary& layer_data(const Judged& judged) {
  static const layer::Dictionary kNone;
  const auto* data =
      judged.stage.stage->root_layer().root().get<layer::Dictionary>(fields::customLayerData);
  return data == nullptr ? kNone : *data;
}

/// The entries of a dictionary, those of its SimReady_Metadata over them.
std::map<std::string, layer::Value> spread(const layer::Dictionary& data) {
  std::map<std::string, layer::Value> all(data.items.begin(), data.items.end());
  all.erase("SimReady_Metadata");
  if (const auto* nested = dictionary_of(data.find("SimReady_Metadata"))) {
    for (const auto& [key, value] : nested->items) {
      all[key] = value;
    }
  }
  return all;
}

std::optional<std::string> text_of(const layer::Value& value) {
  if (const Token* token = value.get<Token>()) {
    return token->str();
  }
  const std::string* text = value.get<std::string>();
  return text == nullptr ? std::nullopt : std::optional<std::string>(*text);
}

bool is_blank(const std::string& text) {
  return text.find_first_not_of(" \t\r\n\f\v") == std::string::npos;
}

bool is_qcode(const std::string& text) {
  return text.size() > 1 && text[0] == 'Q' &&
         std::all_of(text.begin() + 1, text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Three numbers of any type; none for others.
std::optional<std::vector<double>> three_numbers(const layer::Value& value) {
  std::vector<double> found;
  const auto take = [&](const auto* held) {
    if (held != nullptr) {
      for (std::size_t i = 0; i < 3; ++i) {
        found.push_back(static_cast<double>((*held)[i]));
      }
    }
  };
  take(value.get<Vec3f>());
  take(value.get<Vec3d>());
  take(value.get<Vec3i>());
  const auto take_array = [&](const auto* held) {
    if (held != nullptr) {
      for (const auto& one : *held) {
        found.push_back(static_cast<double>(one));
      }
    }
  };
  take_array(value.get<layer::Array<float>>());
  take_array(value.get<layer::Array<double>>());
  take_array(value.get<layer::Array<std::int32_t>>());
  return found.size() == 3 ? std::optional(found) : std::nullopt;
}

const std::vector<std::string> kFactTexts{
    "author",   "asset_name",  "asset_type",         "asset_license",
    "category", "source_file", "usd_date_generated", "qcode"};

/// The same for the numbers among them.
void add_number_faults(const std::map<std::string, layer::Value>& facts,
                       std::vector<std::string>& faults) {
  const auto of = [&](const char* name) -> const layer::Value* {
    const auto found = facts.find(name);
    if (found == facts.end()) {
      faults.push_back(std::string(name) + " is missing");
      return nullptr;
    }
    return &found->second;
  };
  if (const layer::Value* count = of("rigid_body_count")) {
    const bool whole = count->holds<std::int32_t>() || count->holds<std::int64_t>() ||
                       count->holds<std::uint32_t>() || count->holds<std::uint64_t>();
    if (!whole || physics::number_of(*count).value_or(-1) < 0) {
      faults.emplace_back("rigid_body_count is no count");
    }
  }
  if (const layer::Value* extents = of("asset_extents")) {
    const auto sizes = three_numbers(*extents);
    if (!sizes || std::any_of(sizes->begin(), sizes->end(), [](double x) { return x < 0; })) {
      faults.emplace_back("asset_extents are no three sizes");
    }
  }
  if (const layer::Value* mass = of("mass")) {
    if (mass->holds<bool>() || !(physics::number_of(*mass).value_or(0) > 0)) {
      faults.emplace_back("mass is no number above 0");
    }
  }
}

/// What is missing or wrong in the facts about an asset, in words.
std::vector<std::string> faults_of_facts(const std::map<std::string, layer::Value>& facts) {
  std::vector<std::string> faults;
  for (const std::string& name : kFactTexts) {
    const auto found = facts.find(name);
    if (found == facts.end()) {
      faults.push_back(name + " is missing");
    } else if (const auto said = text_of(found->second); said && is_blank(*said)) {
      faults.push_back(name + " is empty");
    } else if (name == "qcode" && (!said || !is_qcode(*said))) {
      faults.emplace_back("qcode is no Q with digits");
    }
  }
  add_number_faults(facts, faults);
  return faults;
}

constexpr const char* kFactsFix =
    "author author, asset_name, asset_type, asset_license, category, source_file, "
    "usd_date_generated, qcode, rigid_body_count, asset_extents and mass in SimReady_Metadata of "
    "the root layer's customLayerData";

std::string thumbnail_of(const std::string& file) {
  const fs::path path(file);
  return (path.parent_path() / ".thumbs/256x256" / (path.filename().string() + ".png")).string();
}

void judge_thumbnail(const Judged& judged, Report& report) {
  const std::string wanted = thumbnail_of(judged.asset.file);
  if (!judged.asset.files.exists(wanted)) {
    report.at_root(judged,
                   "there is no picture .thumbs/256x256/" + fs::path(wanted).filename().string() +
                       " beside the asset",
                   "put a PNG of 256 by 256 pixels there");
  }
}

bool holds_content(const stage::Prim& prim) {
  std::vector<stage::Prim> pending{prim};
  while (!pending.empty()) {
    const stage::Prim at = pending.back();
    pending.pop_back();
    if (!at.is_active() || !at.is_loaded() || !at.is_defined() || at.is_abstract()) {
      continue;
    }
    if (at.is_a(Token("Xform")) || at.is_a(Token("Gprim")) || at.is_a(Token("Material"))) {
      return true;
    }
    if (!at.is_instance()) {
      const std::vector<stage::Prim> children = at.children();
      pending.insert(pending.end(), children.begin(), children.end());
    }
  }
  return false;
}

std::vector<stage::Prim> root_prims(const Judged& judged) {
  std::vector<stage::Prim> roots = judged.stage.stage->pseudo_root().children();
  std::erase_if(roots, [](const stage::Prim& prim) {
    return !prim.is_active() || !prim.is_loaded() || !prim.is_defined() || prim.is_abstract();
  });
  return roots;
}

/// Calls visit(prim, spec site, asset path) for all references and payloads of all opinions.
template <class Visit>
void visit_arcs(const std::vector<stage::Prim>& prims, const Visit& visit) {
  for (const stage::Prim& prim : prims) {
    for (const stage::SpecSite& site : prim.spec_stack()) {
      const auto each = [&](const auto* list) {
        if (list == nullptr) {
          return;
        }
        for (const auto* items :
             {&list->explicit_items, &list->prepended, &list->appended, &list->added}) {
          for (const auto& item : *items) {
            if (!item.asset_path.empty()) {
              visit(prim, site, item.asset_path);
            }
          }
        }
      };
      each(site.spec->get<layer::ListOp<layer::Reference>>(fields::references));
      each(site.spec->get<layer::ListOp<layer::Payload>>(fields::payload));
      if (const auto* one = site.spec->get<layer::Payload>(fields::payload)) {
        if (!one->asset_path.empty()) {
          visit(prim, site, one->asset_path);
        }
      }
    }
  }
}

std::string beside(const std::string& layer, const std::string& path) {
  return (fs::path(layer).parent_path() / path).lexically_normal().string();
}

}  // namespace

void judge_un_006(const Judged& judged, Report& report) {
  Diagnostics ignored;
  if (stage::read_stage_units(*judged.stage.stage, ignored).up_axis != stage::UpAxis::Z) {
    report.at_root(judged, "the up axis is not Z", "author upAxis = \"Z\" and turn the asset");
  }
}

void judge_un_007(const Judged& judged, Report& report) {
  Diagnostics ignored;
  const double unit = stage::read_stage_units(*judged.stage.stage, ignored).meters_per_unit;
  if (unit != 1.0) {
    report.at_root(judged, "metersPerUnit is " + digits(unit) + ", not 1",
                   "author the asset in metres with metersPerUnit = 1");
  }
}

void judge_hi_001(const Judged& judged, Report& report) {
  std::size_t roots = 0;
  for (const stage::Prim& prim : root_prims(judged)) {
    roots += prim == judged.stage.root || holds_content(prim) ? 1 : 0;
  }
  if (roots != 1) {
    report.at_root(judged, "the asset has " + std::to_string(roots) + " root prims with content",
                   "put everything below one root prim");
  }
}

void judge_hi_003(const Judged& judged, Report& report) {
  const stage::Prim root = judged.stage.root;
  if (root && root.parent().is_pseudo_root() && !root.is_a(Token("Xformable"))) {
    report.at(root, "the default prim is no Xform", "make it one");
  }
}

void judge_hi_004(const Judged& judged, Report& report) {
  const stage::Prim root = judged.stage.root;
  if (!root) {
    report.at_root(judged, "there is no default prim", "author defaultPrim");
  } else if (!root.is_active() || root.is_abstract()) {
    report.at(root, "the default prim is inactive or a class", "name one that is used");
  }
}

void judge_hi_010(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (prim.is_defined() || !judged.stage.stage->missing_arcs().empty()) {
      continue;
    }
    report.at(prim, "the prim is overridden, and not defined", "define it, or remove the overs");
  }
}

void judge_vg_025(const Judged& judged, Report& report) {
  constexpr double kTolerance = 1e-4;
  const stage::Prim root = judged.stage.root;
  if (!root || root.is_instance() || !root.is_a(Token("Xformable"))) {
    return;
  }
  const Mat4d local = stage::local_transform(root, stage::Time()).matrix;
  double off = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      off = std::max(off, std::fabs(local[i][j] - (i == j ? 1 : 0)));
    }
  }
  if (off > kTolerance) {
    report.at(root, "the root prim is moved, turned or scaled",
              "leave its transform at the identity and move what is below");
  }
}

void judge_sr_001(const Judged& judged, Report& report) {
  const layer::Dictionary& data = layer_data(judged);
  std::string missing;
  for (const char* name :
       {"SimReady_Metadata", "asset_name", "asset_type", "source_file", "usd_date_generated"}) {
    missing += data.find(name) == nullptr ? (missing.empty() ? "" : ", ") + std::string(name) : "";
  }
  if (!missing.empty()) {
    report.at_root(judged, "customLayerData of the root layer lacks " + missing, "author them");
  }
}

void judge_sr_002(const Judged& judged, Report& report) { judge_thumbnail(judged, report); }
void judge_rc_004(const Judged& judged, Report& report) { judge_thumbnail(judged, report); }

void judge_sr_004(const Judged& judged, Report& report) {
  if (!judged.asset.sidecar.empty() && !judged.asset.facts_beside) {
    report.at_root(judged,
                   "the file " + fs::path(judged.asset.sidecar).filename().string() +
                       " beside the asset is no JSON object",
                   "correct or remove it");
    return;
  }
  std::map<std::string, layer::Value> facts = spread(layer_data(judged));
  if (judged.asset.facts_beside) {
    for (auto& [key, value] : spread(*judged.asset.facts_beside)) {
      if (!facts.emplace(key, value).second) {
        report.at_root(judged, key + " is said in customLayerData and in the file beside the asset",
                       "say it in one of them");
      }
    }
  }
  for (const std::string& fault : faults_of_facts(facts)) {
    report.at_root(judged, "of the facts about the asset, " + fault, kFactsFix);
  }
}

void judge_np_002(const Judged& judged, Report& report) {
  constexpr std::size_t kLongest = 255;
  const fs::path path(judged.asset.file);
  const std::string name = path.filename().string();
  if (!is_plain_name(name) || is_reserved(path.stem().string()) || !is_usd_name(name) ||
      name.size() > kLongest) {
    report.at_root(judged, "the file's name " + name + " is no plain name of a USD file",
                   "use letters, digits, dots, hyphens and underscores");
  }
}

void judge_np_003(const Judged& judged, Report& report) {
  for (const fs::path& part : fs::path(judged.asset.file).parent_path().relative_path()) {
    const std::string name = part.string();
    if (!is_plain_name(name) || is_reserved(name)) {
      report.at_root(judged, "the folder's name " + name + " is not plain",
                     "use letters, digits, dots, hyphens and underscores");
    }
  }
}

void judge_np_004(const Judged& judged, Report& report) {
  constexpr std::size_t kLongest = 260;
  if (judged.asset.file.size() > kLongest) {
    report.at_root(judged,
                   "the path of the file has " + std::to_string(judged.asset.file.size()) +
                       " characters, more than 260",
                   "shorten the names of its folders");
  }
}

void judge_np_005(const Judged& judged, Report& report) {
  const fs::path path(judged.asset.file);
  const std::string asset_folder = path.parent_path().parent_path().filename().string();
  if (asset_folder.empty() ||
      lower(path.stem().string()).find(lower(asset_folder)) == std::string::npos) {
    report.at_root(judged,
                   "the file is not in ASSET/ANYTHING/ASSET.usd, whose name has that of the "
                   "folder above its own",
                   "name the folder above the asset's own as the file");
    return;
  }
  std::size_t assets = 0;
  for (const std::string& name : judged.asset.files.files_in(path.parent_path().string())) {
    assets += is_usd_name(name) ? 1 : 0;
  }
  if (assets > 1) {
    report.at_root(judged, "the asset's folder has " + std::to_string(assets) + " USD files",
                   "leave the asset alone there");
  }
}

void judge_np_006(const Judged& judged, Report& report) {
  const bool beside_it = judged.asset.facts_beside.has_value();
  if (!judged.asset.sidecar.empty() && !beside_it) {
    report.at_root(judged, "the JSON file beside the asset cannot be read", "correct it");
  }
  if (!beside_it && layer_data(judged).find("SimReady_Metadata") == nullptr) {
    report.at_root(judged, "nothing is said about the asset", kFactsFix);
  }
}

void judge_np_007(const Judged& judged, Report& report) {
  visit_arcs(judged.stage.plain,
             [&](const stage::Prim& prim, const stage::SpecSite&, const std::string& path) {
               if (is_absolute(path)) {
                 report.at(prim, "the arc to " + path + " is absolute", "use a relative path");
               }
             });
  for (const auto& [key, value] : layer_data(judged).items) {
    const auto said = text_of(value);
    if (said && is_absolute(*said)) {
      report.at_root(judged, "customLayerData " + key + " is an absolute path",
                     "use a relative path");
    }
  }
}

void judge_np_008(const Judged& judged, Report& report) {
  if (!judged.stage.root) {
    return;
  }
  visit_arcs(judged.stage.every,
             [&](const stage::Prim& prim, const stage::SpecSite& site, const std::string& path) {
               if (prim.path().has_prefix(judged.stage.root.path()) &&
                   !judged.asset.files.exists(beside(site.layer->identifier(), path)) &&
                   path.find('[') == std::string::npos) {
                 report.at(prim, "the arc to " + path + " leads to no file", "correct the path");
               }
             });
  for (const stage::Prim& prim : judged.stage.with_shared) {
    for (const Token& name : prim.authored_property_names()) {
      const layer::Value value = prim.attribute(name).get();
      const auto* asset = value.get<layer::AssetPath>();
      if (asset != nullptr && !asset->authored.empty() && asset->resolved.empty() &&
          asset->authored.find("<UDIM>") == std::string::npos) {
        report.at(prim, name, "the file " + asset->authored + " is not there", "correct the path");
      }
    }
  }
  for (const compose::MissingArc& missing : judged.stage.stage->missing_arcs()) {
    if (missing.arc == "subLayer") {
      report.at_root(judged, "the sublayer " + missing.path + " is not there", "correct the path");
    }
  }
}

void judge_aa_001(const Judged& judged, Report& report) {
  const fs::path root = fs::path(judged.asset.file).parent_path();
  std::set<std::string> told;
  for (const NamedFile& named : judged.asset.named) {
    if (named.authored.empty() || !told.insert(named.layer + "\n" + named.authored).second) {
      continue;
    }
    const bool searched = named.authored.find('/') == std::string::npos &&
                          lower(fs::path(named.authored).extension().string()) == ".mdl";
    const bool anchored = named.authored.starts_with("./") || named.authored.starts_with("../");
    std::string fault;
    if (searched) {
      continue;
    }
    if (!anchored) {
      fault = "does not begin with ./ or ../";
    } else if (named.resolved.empty()) {
      fault = "leads to no file";
    } else if (!named.resolved.starts_with(root.string() + "/")) {
      fault = "lies outside of the asset's folder";
    } else {
      continue;
    }
    report.at_root(judged,
                   "the path " + named.authored + " in " +
                       fs::path(named.layer).filename().string() + " " + fault,
                   "keep the file below the asset's folder and name it from ./ on");
  }
}

void judge_aa_002(const Judged& judged, Report& report) {
  static const std::set<std::string> kAllowed{".usda", ".usdc", ".usd", ".usdz", ".png", ".jpeg",
                                              ".jpg",  ".exr",  ".m4a", ".mp3",  ".wav", ".mdl"};
  std::set<std::string> paths(judged.asset.layers.begin(), judged.asset.layers.end());
  for (const NamedFile& named : judged.asset.named) {
    paths.insert(named.resolved.empty() ? named.authored : named.resolved);
  }
  for (const std::string& path : paths) {
    if (!path.empty() && !kAllowed.contains(fs::path(path).extension().string())) {
      report.at_root(judged,
                     "the asset needs " + fs::path(path).filename().string() +
                         ", a kind of file that no USD asset may bring",
                     "keep only USD layers, images and sounds");
    }
  }
}

void judge_rc_001(const Judged& judged, Report& report) {
  const fs::path path(judged.asset.file);
  for (const std::string& name : judged.asset.files.files_in(path.parent_path().string())) {
    const bool own = lower(name) == lower(path.filename().string()) ||
                     lower(name) == lower(fs::path(judged.asset.sidecar).filename().string());
    if (!own) {
      report.at_root(judged, "the file " + name + " is in the folder of the asset",
                     "move it into a folder, or away");
    }
  }
}

void judge_rc_003(const Judged& judged, Report& report) {
  const fs::path path(judged.asset.file);
  const std::string name = lower(path.filename().string());
  const std::string wanted = name.substr(0, name.find('.'));
  const fs::path folder = path.parent_path();
  if (lower(folder.filename().string()) != wanted &&
      lower(folder.parent_path().filename().string()) != wanted) {
    report.at_root(judged, "neither the asset's folder nor the one above is called " + wanted,
                   "keep a robot as MANUFACTURER/" + wanted + "/" + name);
  }
}

}  // namespace tenon::check::simready
