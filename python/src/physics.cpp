// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The classes of the neutral description are made of its tables of fields (tenon/scene/fields/
// field.h) by the compiler: a class for each struct, a property for each row, the row's meaning and
// unit as its text. What is inlined in JSON is inlined here, so that names are those of JSON in
// snake case. An object of Python is a pointer into the scene, which it keeps alive; so are lists
// (List) and arrays, which are views of the scene's own memory and cannot be written to.
#include "physics.h"

#include <cctype>
#include <cstring>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "failure.h"
#include "field_text.h"
#include "numbers.h"
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <nanobind/typing.h>

#include "tenon/answers/scene_json.h"
#include "tenon/base/wire.h"
#include "tenon/scene/fields/enum_names.h"
#include "tenon/scene/fields/scene_fields.h"

namespace tenon::python {
namespace {

using namespace nb::literals;
using scene::FieldInfo;

/// One property of a class.
struct FieldRow {
  std::string name;
  std::string type;  ///< for signatures
  std::string meaning;
  std::string about;  ///< the meaning alone, without unit and shape
  std::string unit;
  std::string refers;               ///< the list of the scene that it points into
  std::string number;               ///< "float64", "int32", ...; empty: no numbers
  std::vector<std::int64_t> shape;  ///< of numbers; -1: as many as there are
  nb::object (*get)(const void* object, nb::handle owner) = nullptr;
  /// Of all objects of a list; null: it is asked of one after the other.
  nb::object (*column)(const void* first, std::size_t count, nb::handle owner) = nullptr;
};

template <class T>
const std::vector<FieldRow>& rows_of();
template <class T>
nb::object view(const T& value, nb::handle owner);

/// "kg", "rad or m"; empty without a unit.
std::string unit_of(const FieldInfo& info) {
  const std::string angular(unit_text(info.unit, true));
  const std::string linear(unit_text(info.unit, false));
  return angular + (angular == linear ? "" : " or " + linear);
}

/// Says in `row` what its field means.
void tell(const FieldInfo& info, const std::string& shape, FieldRow& row) {
  row.about = info.meaning;
  if (!row.about.empty()) {
    row.about[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(row.about[0])));
  }
  row.unit = unit_of(info);
  row.refers = list_name(info.refers);
  row.meaning = row.about + (row.refers.empty() ? "" : "; an index into " + row.refers) +
                (row.unit.empty() ? "" : " [" + row.unit + "]") + shape + ".";
}

// ---- lists

/// A list of objects of the scene, or those of it that a slice names.
struct List {
  const void* first = nullptr;
  std::size_t whole = 0;  ///< how many there are from `first` on
  std::size_t start = 0;  ///< of the slice, into these, and its step
  Py_ssize_t step = 1;
  std::size_t count = 0;
  nb::object (*item)(const void* first, std::size_t at, nb::handle owner) = nullptr;
  const std::vector<FieldRow>* rows = nullptr;  ///< null: its items are no objects
  std::size_t stride = 0;
  nb::object owner;
};

template <class T>
nb::object list_of(const std::vector<T>& items, nb::handle owner) {
  List list;
  list.first = items.data();
  list.whole = list.count = items.size();
  list.stride = sizeof(T);
  list.item = [](const void* first, std::size_t at, nb::handle kept) {
    return view(static_cast<const T*>(first)[at], kept);
  };
  if constexpr (scene::HasTable<T>) {
    list.rows = &rows_of<T>();
  }
  list.owner = nb::borrow(owner);
  return nb::cast(std::move(list));
}

/// The address of an object of the list, counted from `first`.
std::size_t place_in(const List& list, std::size_t at) {
  return static_cast<std::size_t>(static_cast<Py_ssize_t>(list.start) +
                                  list.step * static_cast<Py_ssize_t>(at));
}

nb::object item_of(const List& list, Py_ssize_t at) {
  const auto count = static_cast<Py_ssize_t>(list.count);
  if (at < -count || at >= count) {
    throw nb::index_error(
        ("there is no object " + std::to_string(at) + "; there are " + std::to_string(count))
            .c_str());
  }
  const auto counted = static_cast<std::size_t>(at < 0 ? at + count : at);
  return list.item(list.first, place_in(list, counted), list.owner);
}

/// What is found in Python: names, and texts for people.
nb::object ask_python(const char* function, nb::handle self) {
  return nb::module_::import_("tenon_usd._lists").attr(function)(self);
}

nb::object item_named(nb::handle_t<List> self, const nb::str& name) {
  const nb::object at = nb::module_::import_("tenon_usd._lists").attr("index")(self, name);
  return item_of(*nb::inst_ptr<List>(self), nb::cast<Py_ssize_t>(at));
}

nb::object slice_of(const List& list, const nb::slice& slice) {
  const auto [start, stop, step, length] = slice.compute(list.count);
  List part = list;
  part.start = length == 0 ? 0 : place_in(list, static_cast<std::size_t>(start));
  part.step = list.step * step;
  part.count = length;
  return nb::cast(std::move(part));
}

nb::list items_of(const List& list) {
  nb::list items;
  for (std::size_t i = 0; i < list.count; ++i) {
    items.append(list.item(list.first, place_in(list, i), list.owner));
  }
  return items;
}

/// Of a column of all objects the part of the slice.
nb::object part_of(const List& list, const nb::object& column) {
  if (list.start == 0 && list.step == 1 && list.count == list.whole) {
    return column;
  }
  const auto begin = static_cast<Py_ssize_t>(list.start);
  const Py_ssize_t end = begin + list.step * static_cast<Py_ssize_t>(list.count);
  const nb::object stop = end < 0 ? nb::none() : nb::cast(end);
  return column[nb::module_::import_("builtins").attr("slice")(begin, stop, list.step)];
}

nb::object column_of(const List& list, const std::string& name) {
  if (list.rows != nullptr) {
    for (const FieldRow& row : *list.rows) {
      if (row.name != name) {
        continue;
      }
      if (row.column != nullptr) {
        return part_of(list, row.column(list.first, list.whole, list.owner));
      }
      nb::list values;
      for (std::size_t i = 0; i < list.count; ++i) {
        values.append(row.get(
            static_cast<const char*>(list.first) + place_in(list, i) * list.stride, list.owner));
      }
      return values;
    }
  }
  throw nb::key_error(name.c_str());
}

// ---- values

nb::object quaternion(const Quatd& q) {
  NewArray<> made({4});
  made.numbers = {q.w, q.x, q.y, q.z};
  return made.take_locked();  // of a property: a write would be lost
}

template <class T>
nb::object view_of_many(const std::vector<T>& items, nb::handle owner) {
  if constexpr (kHasNumbers<T>) {
    return number_rows(items.data(), items.size(), owner);
  } else if constexpr (kIsIndexPair<T>) {
    static_assert(sizeof(T) == sizeof(std::array<scene::Index, 2>));
    return number_rows(reinterpret_cast<const std::array<scene::Index, 2>*>(items.data()),
                       items.size(), owner);
  } else {
    return list_of(items, owner);
  }
}

/// What Python has of a value of the scene, which `owner` keeps alive.
template <class T>
nb::object view(const T& value, nb::handle owner) {
  if constexpr (std::is_arithmetic_v<T>) {
    return nb::cast(value);
  } else if constexpr (std::is_enum_v<T>) {
    return nb::cast(std::string(scene::name_of(value)));
  } else if constexpr (std::is_same_v<T, std::string>) {
    return text(value);
  } else if constexpr (std::is_same_v<T, Path>) {
    return text(value.str());
  } else if constexpr (wire::kIsOptional<T>) {
    return value ? view(*value, owner) : nb::none();
  } else if constexpr (std::is_same_v<T, Quatd>) {
    return quaternion(value);
  } else if constexpr (kHasNumbers<T>) {
    return numbers(value, owner);
  } else if constexpr (wire::kIsVector<T>) {
    return view_of_many(value, owner);
  } else if constexpr (wire::kIsPair<T>) {
    return nb::make_tuple(view(value.first, owner), view(value.second, owner));
  } else {
    nb::object made = nb::cast(&value, nb::rv_policy::reference);
    nb::keep_alive_obj(made, owner);
    return made;
  }
}

// ---- rows

template <class T>
const T& member(const T& object) {
  return object;
}
template <auto First, auto... Rest, class T>
const auto& member(const T& object) {
  if constexpr (sizeof...(Rest) == 0) {
    return object.*First;
  } else {
    return member<Rest...>(object.*First);
  }
}

/// Rows of the field of `T` that the chain of members leads to.
template <class T, auto... Chain>
FieldRow row_of(const FieldInfo& info) {
  using Value = std::remove_cvref_t<decltype(member<Chain...>(std::declval<const T&>()))>;
  FieldRow row;
  row.name = snake_case(info.name);
  row.type = type_text<Value>();
  row.number = number_name<Value>();
  row.shape = number_shape<Value>();
  tell(info, shape_of<Value>(), row);
  row.get = [](const void* object, nb::handle owner) {
    return view(member<Chain...>(*static_cast<const T*>(object)), owner);
  };
  if constexpr (kHasNumbers<Value>) {
    using Number = typename NumbersOf<Value>::Number;
    if constexpr (sizeof(T) % sizeof(Number) == 0) {
      row.column = [](const void* first, std::size_t count, nb::handle owner) {
        const Value* at = count == 0 ? nullptr : &member<Chain...>(*static_cast<const T*>(first));
        return number_rows(at, count, owner, sizeof(T));
      };
    }
  }
  return row;
}

template <class T, auto... Chain>
void add_rows(const FieldInfo& info, std::vector<FieldRow>& rows);

template <class T, auto... Chain, auto... Members>
void add_table(const scene::Rows<Members...>& table, std::vector<FieldRow>& rows) {
  const FieldInfo* info = table.infos;
  (add_rows<T, Chain..., Members>(*info++, rows), ...);
}

template <class T, auto... Chain>
void add_rows(const FieldInfo& info, std::vector<FieldRow>& rows) {
  using Value = std::remove_cvref_t<decltype(member<Chain...>(std::declval<const T&>()))>;
  if constexpr (std::is_same_v<Value, Pose>) {
    const std::string prefix = info.inlined ? "" : std::string(info.name) + "_";
    FieldInfo part = info;
    const std::string position = prefix + "position";
    const std::string orientation = prefix + "orientation";
    part.unit = scene::Unit::Meter;
    part.name = position;
    rows.push_back(row_of<T, Chain..., &Pose::position>(part));
    part.unit = scene::Unit::None;
    part.name = orientation;
    rows.push_back(row_of<T, Chain..., &Pose::orientation>(part));
  } else if constexpr (scene::HasTable<Value>) {
    if (info.inlined) {
      add_table<T, Chain...>(scene::Table<Value>::kFields, rows);
    } else {
      rows.push_back(row_of<T, Chain...>(info));
    }
  } else {
    rows.push_back(row_of<T, Chain...>(info));
  }
}

template <class T>
std::vector<FieldRow> make_rows() {
  static_assert(scene::is_complete<T>(), "a member has no row in its table");
  std::vector<FieldRow> rows;
  add_table<T>(scene::Table<T>::kFields, rows);
  return rows;
}

template <class T>
const std::vector<FieldRow>& rows_of() {
  static const std::vector<FieldRow> rows = make_rows<T>();
  return rows;
}

// ---- classes

/// Reads one property; the type of the object is that of the enclosing class.
struct Getter {
  const FieldRow* row;
  nb::handle type;

  nb::object operator()(nb::handle self) const {
    if (PyObject_TypeCheck(self.ptr(), reinterpret_cast<PyTypeObject*>(type.ptr())) == 0) {
      throw nb::type_error("this is a property of another class");
    }
    return row->get(nb::inst_ptr<void>(self), self);
  }
};

void add_property(nb::handle type, const FieldRow& row) {
  const std::string signature = "def " + row.name + "(self) -> " + row.type;
  const nb::object getter = nb::cpp_function(
      Getter{&row, type}, nb::scope(type), nb::name(row.name.c_str()), nb::is_method(),
      nb::is_getter(), nb::sig(signature.c_str()), row.meaning.c_str());
  type.attr(row.name.c_str()) =
      nb::module_::import_("builtins").attr("property")(getter, nb::none(), nb::none());
}

/// The description of each property: for tables (tenon_usd/tables.py).
nb::dict columns_of(const std::vector<FieldRow>& rows) {
  nb::dict columns;
  for (const FieldRow& row : rows) {
    nb::dict column;
    column["type"] = row.type;
    column["unit"] = row.unit;
    column["meaning"] = row.about;
    column["refers"] = row.refers;
    column["number"] = row.number;
    column["shape"] = nb::tuple(nb::cast(row.shape));
    columns[row.name.c_str()] = column;
  }
  return columns;
}

/// Binds `Bound`, at whose beginning a T lies, with the properties of T.
template <class T, class Bound = T>
nb::class_<Bound> bind_class(nb::module_& module) {
  const std::string name = class_name<T>();
  const std::string about =
      "A " + std::string(scene::Table<T>::kWord) + " of the neutral description [SI, rad].";
  nb::class_<Bound> bound(module, name.c_str(), about.c_str());
  for (const FieldRow& row : rows_of<T>()) {
    add_property(bound, row);
  }
  const nb::dict columns = columns_of(rows_of<T>());
  bound.def(
      "__repr__", [](nb::handle self) { return ask_python("describe", self); },
      nb::sig("def __repr__(self) -> str"));
  bound.attr("FIELDS") = nb::tuple(columns);
  bound.attr("COLUMNS") = columns;
  return bound;
}

/// Binds every struct that is met below, once.
class ClassBinder {
 public:
  explicit ClassBinder(nb::module_& module) : module_(module) {}

  template <class T>
  void bind_below() {
    scene::each_field_type<T>(
        [&](const FieldInfo&, auto type) { meet<typename decltype(type)::type>(); });
  }

 private:
  template <class T>
  void meet() {
    if constexpr (wire::kIsOptional<T> || wire::kIsVector<T>) {
      meet<typename T::value_type>();
    } else if constexpr (wire::kIsPair<T>) {
      meet<typename T::first_type>();
      meet<typename T::second_type>();
    } else if constexpr (scene::HasTable<T>) {
      if (!nb::type<T>().is_valid()) {
        bind_class<T>(module_);
        bind_below<T>();
      }
    }
  }

  nb::module_& module_;
};

void bind_pose(nb::module_& module) {
  nb::class_<Pose> pose(module, "Pose", "Where a frame is, seen from another one.");
  const auto part = [&pose](const char* name, auto get, const char* meaning) {
    pose.def_prop_ro(
        name, [get](nb::handle_t<Pose> self) { return get(*nb::inst_ptr<Pose>(self), self); },
        nb::sig((std::string("def ") + name + "(self) -> NDArray[Any]").c_str()), meaning);
  };
  part(
      "position", [](const Pose& self, nb::handle owner) { return view(self.position, owner); },
      "Of the origin [m] (3).");
  part(
      "orientation",
      [](const Pose& self, nb::handle owner) { return view(self.orientation, owner); },
      "(4): w, x, y, z.");
  std::vector<FieldRow> rows(2);
  rows[0].name = "position";
  rows[0].unit = unit_text(scene::Unit::Meter, true);
  rows[0].about = "Of the origin";
  rows[0].shape = number_shape<Vec3d>();
  rows[1].name = "orientation";
  rows[1].about = "w, x, y, z";
  rows[1].shape = number_shape<Quatd>();
  for (FieldRow& row : rows) {
    row.type = "NDArray[Any]";
    row.number = number_name<Vec3d>();
  }
  pose.attr("COLUMNS") = columns_of(rows);
  pose.def(
      "__repr__", [](nb::handle self) { return ask_python("describe", self); },
      nb::sig("def __repr__(self) -> str"));
}

/// By path or name.
void bind_list_names(nb::class_<List>& list) {
  list.def(
      "index",
      [](nb::handle_t<List> self, const nb::str& name) {
        return nb::cast<std::size_t>(
            nb::module_::import_("tenon_usd._lists").attr("index")(self, name));
      },
      "name"_a,
      "The number of the object of a path, or of a name that no other one has: the index that "
      "other "
      "objects have of it. Raises KeyError.");
  list.def(
      "__contains__",
      [](nb::handle_t<List> self, const nb::object& name) {
        return nb::cast<bool>(
            nb::module_::import_("tenon_usd._lists").attr("contains")(self, name));
      },
      "name"_a, nb::sig("def __contains__(self, name: object) -> bool"),
      "Whether there is an object of this path.");
}

void bind_list(nb::module_& module) {
  nb::class_<List> list(module, "List", nb::is_generic(), nb::sig("class List(Generic[T])"),
                        "A list of objects of a scene, without a copy.");
  list.def("__len__", [](const List& self) { return self.count; });
  list.def("__getitem__", &item_of, "at"_a, nb::sig("def __getitem__(self, at: int, /) -> T"));
  list.def("__getitem__", &item_named, "at"_a, nb::sig("def __getitem__(self, at: str, /) -> T"),
           "The object of a path, or of a name that no other one has. Raises KeyError.");
  list.def("__getitem__", &slice_of, "at"_a,
           nb::sig("def __getitem__(self, at: slice, /) -> List[T]"),
           "A part of the list, without a copy.");
  bind_list_names(list);
  list.def(
      "__iter__", [](const List& self) { return nb::iter(items_of(self)); },
      nb::sig("def __iter__(self) -> Iterator[T]"));
  list.def("column", &column_of, "name"_a, nb::sig("def column(self, name: str) -> Any"),
           "One property of all objects, in its unit: of numbers a read-only NumPy view without a "
           "copy (count, ...), else a list. Raises KeyError for an unknown name.");
  list.def_prop_ro(
      "columns",
      [](const List& self) { return self.rows == nullptr ? nb::dict() : columns_of(*self.rows); },
      nb::sig("def columns(self) -> dict[str, dict[str, Any]]"),
      "The description of each property of the objects: {\"type\", \"unit\", \"meaning\", "
      "\"refers\", \"number\", \"shape\"}.");
  // A table in Python: pandas and Arrow are the user's.
  const auto table = [&list](const char* name, const char* text) {
    list.def(
        name,
        [name](nb::handle self) {
          return nb::module_::import_("tenon_usd.tables").attr(name)(self);
        },
        nb::sig((std::string("def ") + name + "(self) -> Any").c_str()), text);
  };
  table("to_arrow",
        "A pyarrow.Table with a row for each object; fields tell unit and meaning in their "
        "metadata. Raises MissingError without pyarrow.");
  table("to_pandas",
        "A pandas.DataFrame with a row for each object, vectors as columns \"position.x\"; its "
        "attrs[\"units\"] has the unit of each. Raises MissingError without pandas.");
  list.def(
      "__repr__", [](nb::handle self) { return ask_python("describe_list", self); },
      nb::sig("def __repr__(self) -> str"));
  list.def(
      "_repr_html_", [](nb::handle self) { return ask_python("html_of_list", self); },
      nb::sig("def _repr_html_(self) -> str"), "A table for notebooks.");
}

bool may_collide(const ReadScene& read, std::size_t a, std::size_t b) {
  const std::size_t count = read.scene.colliders.size();
  if (a >= count || b >= count) {
    throw nb::index_error();
  }
  return read.scene.may_collide(static_cast<scene::Index>(a), static_cast<scene::Index>(b));
}

std::shared_ptr<ReadScene> scene_of_json(const std::string& json) {
  auto read = std::make_shared<ReadScene>();
  read->scene = or_raise(unlocked([&] { return answers::read_scene_json(json); }));
  return read;
}

}  // namespace

void bind_physics(nb::module_& module) {
  module.attr("T") = nb::type_var("T");
  bind_list(module);
  bind_pose(module);
  static_assert(offsetof(ReadScene, scene) == 0);
  nb::class_<ReadScene> bound = bind_class<scene::PhysicsScene, ReadScene>(module);
  ClassBinder(module).bind_below<scene::PhysicsScene>();
  bound.def_prop_ro(
      "diagnostics", [](const ReadScene& self) { return to_list(self.diagnostics); },
      nb::sig("def diagnostics(self) -> list[Diagnostic]"), "What reading the physics found.");
  bound.def(
      "_repr_html_", [](nb::handle self) { return ask_python("html_of_scene", self); },
      nb::sig("def _repr_html_(self) -> str"), "A table for notebooks.");
  bound.def("may_collide", &may_collide, "collider0"_a, "collider1"_a,
            "Contacts between two colliders, given by index, are possible.");
  bound.def(
      "json",
      [](const ReadScene& self, bool geometry) {
        return message(or_raise(unlocked([&]() -> Result<std::string> {
          if (geometry) {
            TENON_CHECK(answers::check_inline_json(self.scene));
          }
          return answers::scene_json(
              self.scene, geometry ? answers::Geometry::Inline : answers::Geometry::Hash);
        })));
      },
      nb::kw_only(), "geometry"_a = false,
      "As JSON text [SI, rad], as `tenon physics --json` prints it; with `geometry` points and "
      "triangles of meshes [m], else a hash of them. Raises for more than from_json() takes.");
  bound.def_static("from_json", &scene_of_json, "json"_a,
                   "The scene that JSON with geometry describes. Raises for faulty JSON.");
}

}  // namespace tenon::python
