// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/data_type.h"

#include <set>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include "tenon/scene/fields/make_data_type.h"
#include "tenon/scene/test_filled_scene.h"

namespace tenon::scene {
namespace {

/// What the compiler knows of a value and of all in it, beside what its data type says.
class Beside {
 public:
  int leaves() const { return leaves_; }

  template <class T>
  void look(const T& value, DataView view) {
    ASSERT_EQ(view.at, static_cast<const void*>(&value));
    ASSERT_TRUE(view.is_a<T>());
    ASSERT_EQ(view.type->size, sizeof(T));
    if constexpr (HasTable<T>) {
      std::size_t at = 0;
      each_field(value, [&](const FieldInfo& info, const auto& member) {
        ASSERT_LT(at, view.type->fields.size());
        const DataField& field = view.type->fields[at++];
        ASSERT_EQ(field.info, &info);
        look(member, view.member(field));
      });
      EXPECT_EQ(at, view.type->fields.size()) << view.type->word;
    } else if constexpr (wire::kIsVector<T>) {
      ASSERT_EQ(view.size(), value.size());
      for (std::size_t i = 0; i < value.size(); ++i) {
        look(value[i], view[i]);
      }
    } else if constexpr (wire::kIsOptional<T>) {
      ASSERT_EQ(view.size() == 1, value.has_value());
      look(*value, view[0]);
    } else if constexpr (wire::kIsPair<T>) {
      look(value.first, view.first());
      look(value.second, view.second());
    } else {
      leaf(value, view);
    }
  }

 private:
  template <class T>
  void leaf(const T& value, DataView view) {
    ++leaves_;
    if constexpr (std::is_enum_v<T>) {
      EXPECT_EQ(word_of(view), name_of(value));
    } else if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      EXPECT_EQ(number_of(view), static_cast<double>(value));
    } else if constexpr (std::is_same_v<T, Pose>) {
      leaf(value.position, view.first());
      leaf(value.orientation, view.second());
    }
  }

  int leaves_ = 0;
};

TEST(DataType, SeesEveryFieldWhereTheTablesHaveIt) {
  const PhysicsScene scene = filled_scene();
  Beside beside;
  beside.look(scene, view_of(scene));
  EXPECT_GT(beside.leaves(), 700);
}

enum class Grip : std::uint8_t { Open, Shut };
struct Finger {
  int joints = -3;
  char flag = -1;
  Grip grip = Grip::Shut;
  bool thumb = false;
  double force = 0.5;
};

}  // namespace

template <>
struct EnumNames<Grip> {
  static constexpr std::array<std::string_view, 2> kNames{"open", "shut"};
};
template <>
struct Table<Finger> {
  static constexpr std::string_view kWord = "finger";
  static constexpr Rows kFields{
      field<&Finger::joints>({.name = "joints", .meaning = "how many"}),
      field<&Finger::flag>({.name = "flag", .meaning = "any"}),
      field<&Finger::grip>({.name = "grip", .meaning = "how it stands"}),
      field<&Finger::thumb>({.name = "thumb", .meaning = "is one"}),
      field<&Finger::force>({.name = "force", .meaning = "of it"}),
  };
};

namespace {

/// A struct that the scene does not have: nothing but its table makes it known.
TEST(DataType, IsMadeOfAnyTable) {
  Finger finger;
  const DataRef ref = ref_to(finger);
  const auto member = [&](const char* name) { return ref.member(*find_field(*ref.type, name)); };
  EXPECT_EQ(number_of(member("joints")), -3);
  EXPECT_EQ(number_of(member("flag")), -1);
  EXPECT_EQ(word_of(member("grip")), "shut");
  EXPECT_EQ(find_field(*ref.type, "thumbs"), nullptr);
  EXPECT_EQ(path_of(DataView(ref)), nullptr);

  set_integer(member("joints"), -7);
  set_integer(member("grip"), 0);
  set_number(member("force"), 2.5);
  member("thumb").as<bool>() = true;
  EXPECT_EQ(finger.joints, -7);
  EXPECT_EQ(finger.grip, Grip::Open);
  EXPECT_EQ(finger.force, 2.5);
  EXPECT_TRUE(finger.thumb);
  EXPECT_EQ(static_cast<const Finger*>(ref.type->plain)->joints, -3);
  ref.assign({ref.type, ref.type->plain});
  EXPECT_EQ(finger.joints, -3);

  const IntegerRange range = integer_range(*member("joints").type);
  EXPECT_EQ(range.lowest, -2147483648.0);
  EXPECT_EQ(range.highest, 2147483647.0);
  EXPECT_EQ(integer_range(data_type<Index>()).highest, 4294967295.0);
}

}  // namespace
}  // namespace tenon::scene
