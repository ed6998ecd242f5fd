// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutants/seeds.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

namespace tenon::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestSeed = 256u << 10;
constexpr std::size_t kMaxCompanions = 24;
constexpr std::size_t kLongestName = 200;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

Kind kind_of(std::string_view path, std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 4000);
  const auto in_head = [&](std::string_view word) {
    return head.find(word) != std::string_view::npos;
  };
  const std::pair<bool, Kind> tests[] = {
      {bytes.starts_with("#usda"), Kind::Text},
      {bytes.starts_with("PXR-USDC"), Kind::Crate},
      {bytes.starts_with("PK\3\4"), Kind::Package},
      {bytes.starts_with("\x89PNG"), Kind::Png},
      {path.ends_with(".stl"), Kind::Stl},
      {path.ends_with(".obj"), Kind::Obj},
      {path.ends_with(".gltf"), Kind::Gltf},
      {in_head("<COLLADA"), Kind::Dae},
      {in_head("<mujoco"), Kind::Mjcf},
      {path.ends_with(".sdf") && in_head("<sdf"), Kind::Sdf},
      {in_head("<robot"), Kind::Urdf},
  };
  for (const auto& [found, kind] : tests) {
    if (found) {
      return kind;
    }
  }
  return Kind::Other;
}

/// Calls `use` with each piece of a line between two equal quotes or at signs.
template <class Use>
void for_each_quoted(std::string_view bytes, const Use& use) {
  for (const char quote : {'@', '"', '\''}) {
    std::size_t from = bytes.find(quote);
    while (from != std::string_view::npos) {
      const std::size_t end = bytes.find(quote, from + 1);
      if (end == std::string_view::npos) {
        break;
      }
      if (end - from - 1 <= kLongestName && end > from + 1) {
        use(bytes.substr(from + 1, end - from - 1));
      }
      from = end;
    }
  }
}

using Places = std::map<std::string, std::size_t, std::less<>>;

std::vector<std::size_t> companions_of(std::size_t root, const std::vector<Seed>& seeds,
                                       const Places& places) {
  const std::string_view within = folder_of(seeds[root].path);
  std::vector<std::size_t> found = {root};
  for (std::size_t next = 0; next < found.size() && found.size() <= kMaxCompanions; ++next) {
    const Seed& seed = seeds[found[next]];
    for_each_quoted(seed.bytes, [&](std::string_view name) {
      const fs::path path = fs::path(folder_of(seed.path)) / name;
      const auto place = places.find(path.lexically_normal().generic_string());
      if (place != places.end() && place->first.starts_with(within) &&
          std::find(found.begin(), found.end(), place->second) == found.end()) {
        found.push_back(place->second);
      }
    });
  }
  found.erase(found.begin());
  return found;
}

std::vector<std::pair<std::string, fs::path>> files_below(const std::vector<std::string>& folders) {
  std::vector<std::pair<std::string, fs::path>> files;
  for (const std::string& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
      const bool compiled = entry.path().extension() == ".pyc";
      if (!compiled && entry.is_regular_file(error) && entry.file_size(error) <= kLargestSeed) {
        const fs::path base = fs::path(folder).lexically_normal();
        const fs::path name = base.has_filename() ? base.filename() : base.parent_path().filename();
        const fs::path inside = entry.path().lexically_relative(folder);
        files.emplace_back((name / inside).generic_string(), entry.path());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string_view folder_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? std::string_view() : path.substr(0, slash + 1);
}

Seeds Seeds::load(const std::vector<std::string>& folders) {
  Seeds all;
  Places places;
  for (const auto& [name, path] : files_below(folders)) {
    Seed seed;
    seed.path = name;
    seed.bytes = bytes_of(path);
    seed.kind = kind_of(name, seed.bytes);
    places.emplace(name, all.seeds_.size());
    all.of_kind_[static_cast<std::size_t>(seed.kind)].push_back(all.seeds_.size());
    all.seeds_.push_back(std::move(seed));
  }
  for (std::size_t i = 0; i < all.seeds_.size(); ++i) {
    all.seeds_[i].companions = companions_of(i, all.seeds_, places);
  }
  return all;
}

const Seed& Seeds::pick(Kind kind, Dice& dice) const {
  const auto& places = of_kind_[static_cast<std::size_t>(kind)];
  return seeds_[places[dice.below(places.size())]];
}

std::uint64_t Seeds::digest() const {
  std::uint64_t digest = 0xcbf29ce484222325;  // FNV-1a
  const auto add = [&](std::string_view bytes) {
    for (const char c : bytes) {
      digest = (digest ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    }
  };
  for (const Seed& seed : seeds_) {
    add(seed.path);
    add(seed.bytes);
  }
  return digest;
}

}  // namespace tenon::fuzz
