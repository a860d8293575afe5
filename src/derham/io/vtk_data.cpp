#include "derham/io/vtk_data.hpp"

#include "derham/core/text.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace derham {
namespace {

constexpr Offset most_components = 1 << 20, most_tuples = Offset{1} << 40;

// Names of arrays are written with blanks, quotes, % and all but ASCII as %XX.
std::string decoded_name(std::string_view name) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '%' && i + 2 < name.size() && digit(name[i + 1]) >= 0 && digit(name[i + 2]) >= 0) {
      out += static_cast<char>(16 * digit(name[i + 1]) + digit(name[i + 2]));
      i += 2;
    } else {
      out += name[i];
    }
  }
  return out;
}

// What an array holds: numbers, of which fields are made, or something else.
struct ArrayType {
  enum class Kind : std::uint8_t { numbers, bits, texts };
  Kind kind = Kind::numbers;
  NumberType number = NumberType::float64;
};

ArrayType take_array_type(VtkInput& input) {
  (void)input.file.at_line_end();
  const auto start = input.file.offset();
  const auto name = lower_case(input.file.word("the type of the array"));
  if (name == "bit") return {ArrayType::Kind::bits};
  if (name == "string") return {ArrayType::Kind::texts};
  input.file.rewind(start);
  return {ArrayType::Kind::numbers, input.number_type("the type of the array")};
}

class DataReader {
 public:
  DataReader(VtkInput& input, MeshData& mesh) : input_(input), file_(input.file), mesh_(mesh) {}

  // Everything up to a line that is no part of the data.
  void read_all(MeshField::On on, Offset items) {
    const auto take = [&](const std::string& name, Offset components, Offset tuples, ArrayType type) {
      if (tuples != items) file_.fail(text("array ", quoted_token(name), " has ", tuples, " tuples, expected ", items));
      MeshField field{name, on, static_cast<int>(components), {}};
      if (read_array(name, components, tuples, type, field.values)) mesh_.fields.push_back(std::move(field));
    };
    while (file_.next_line()) {
      const auto start = file_.offset();
      const auto keyword = lower_case(file_.word("an attribute"));
      if (keyword == "metadata") {
        input_.skip_metadata();
      } else if (keyword == "field") {
        read_field_data(take);
      } else if (keyword == "lookup_table") {
        skip_lookup_table();
      } else if (!read_attribute(keyword, items, take)) {
        file_.rewind(start);
        return;
      }
    }
  }

  // FIELD: arrays with names, each given to `take`.
  template <class Take>
  void read_field_data(Take take) {
    (void)file_.word("the name of the field data");
    const Index count = file_.count("the number of arrays", 6);
    file_.end_line();
    for (Index i = 0; i < count; ++i) {
      if (!file_.next_line()) fail_arrays(i, count);
      auto name = file_.word("the name of an array");
      if (name == "METADATA") {
        input_.skip_metadata();
        if (!file_.next_line()) fail_arrays(i, count);
        name = file_.word("the name of an array");
      }
      const auto components = file_.integer("the number of components", 1, most_components);
      const auto tuples = file_.integer("the number of tuples", 0, most_tuples);
      const auto type = take_array_type(input_);
      file_.end_line();
      take(decoded_name(name), components, tuples, type);
    }
  }

  // Appends the numbers of an array to `values`; one that holds none is skipped: false.
  bool read_array(std::string_view name, Offset components, Offset tuples, ArrayType type,
                  std::vector<double>& values) {
    const auto count = components * tuples;
    if (type.kind == ArrayType::Kind::numbers) {
      note_rounded(mesh_, name, input_.numbers(tuples, components, type.number, "an array").values(count, values));
      return true;
    }
    const bool is_text = type.kind == ArrayType::Kind::texts;
    is_text ? input_.skip_texts(count) : input_.skip_bits(count);
    mesh_.notes.push_back(
        text("array ", quoted_token(name), is_text ? " of strings is not kept" : " of bits is not kept"));
    return false;
  }

 private:
  // SCALARS, VECTORS and their like; false if it is none of them.
  template <class Take>
  bool read_attribute(const std::string& keyword, Offset items, Take take) {
    struct Attribute {
      std::string_view name;
      int components = 0;  // 0: given
    };
    constexpr std::array attributes{
        Attribute{"scalars", 1},    Attribute{"vectors", 3},      Attribute{"normals", 3},
        Attribute{"tensors", 9},    Attribute{"tensors6", 6},     Attribute{"texture_coordinates", 0},
        Attribute{"global_ids", 1}, Attribute{"pedigree_ids", 1}, Attribute{"color_scalars", 0}};
    const auto* const found = std::ranges::find(attributes, std::string_view(keyword), &Attribute::name);
    if (found == attributes.end()) return false;
    const auto name = decoded_name(file_.word("the name of the array"));
    Offset components = found->components;
    ArrayType type{ArrayType::Kind::numbers, input_.is_text() ? NumberType::float32 : NumberType::uint8};  // of colours
    if (components == 0) components = file_.integer("the number of components", 1, most_components);
    if (keyword != "color_scalars") type = take_array_type(input_);
    if (keyword == "scalars" && !file_.at_line_end())
      components = file_.integer("the number of components", 1, most_components);
    file_.end_line();
    if (keyword == "scalars") skip_table_line();
    take(name, components, items, type);
    return true;
  }

  // SCALARS may name the table of their colours.
  void skip_table_line() {
    const auto start = file_.offset();
    if (file_.next_line() && lower_case(file_.word("LOOKUP_TABLE")) == "lookup_table") {
      (void)file_.word("the name of the table");
      file_.end_line();
    } else {
      file_.rewind(start);
    }
  }

  void skip_lookup_table() {
    (void)file_.word("the name of the table");
    const Index colors = file_.count("the number of colours", 4);
    file_.end_line();
    const auto type = input_.is_text() ? NumberType::float32 : NumberType::uint8;
    std::vector<double> dropped;
    (void)input_.numbers(colors, 4, type, "LOOKUP_TABLE").values(Offset{colors} * 4, dropped);
  }

  [[noreturn]] void fail_arrays(Index read, Index count) {
    file_.fail(text("the file ends after ", read, " of ", count, " arrays"));
  }

  VtkInput& input_;
  Cursor& file_;
  MeshData& mesh_;
};

}  // namespace

void read_vtk_data(VtkInput& input, MeshField::On on, Offset items, MeshData& mesh) {
  DataReader(input, mesh).read_all(on, items);
}

void skip_vtk_field_data(VtkInput& input, MeshData& mesh) {
  DataReader reader(input, mesh);
  reader.read_field_data([&](const std::string& name, Offset components, Offset tuples, ArrayType type) {
    std::vector<double> dropped;
    if (!reader.read_array(name, components, tuples, type, dropped)) return;
    mesh.notes.push_back(text("array ", quoted_token(name), " of the whole data set is not kept"));
  });
}

}  // namespace derham
