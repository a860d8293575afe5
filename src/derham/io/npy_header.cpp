// This follows the numpy documentation, "numpy.lib.format", versions 1.0 to 3.0.
#include "derham/core/text.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/npy.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <exception>
#include <limits>
#include <system_error>

namespace derham {
namespace {

constexpr bool is_little = std::endian::native == std::endian::little;

// The header: a Python dictionary with the keys descr, fortran_order and shape.
class Header {
 public:
  Header(std::string_view dictionary, const NpyFail& complain) : rest_(dictionary), complain_(complain) {}

  void parse(NpyArray& array) {
    expect('{');
    int seen = 0;
    while (!accept('}')) {
      const auto key = string();
      expect(':');
      const int bit = key == "descr" ? 1 : key == "fortran_order" ? 2 : key == "shape" ? 4 : 0;
      if (bit == 0 || (seen & bit) != 0) fail("the key " + quoted_token(key));
      seen |= bit;
      if (bit == 1)
        take_type(array);
      else if (bit == 2)
        array.fortran = truth();
      else
        take_shape(array);
      if (accept(',')) continue;
      expect('}');
      break;
    }
    if (seen != 7) fail("a header without descr, fortran_order or shape");
    blanks();
    if (!rest_.empty()) fail(quoted_token(rest_) + " behind the header");
  }

 private:
  [[noreturn]] void fail(const std::string& found) const {
    complain_("the header of the array has " + found +
              "; expected {'descr': …, 'fortran_order': …, 'shape': (…)} as numpy writes it");
    std::terminate();
  }
  void blanks() {
    while (!rest_.empty() && (rest_[0] == ' ' || rest_[0] == '\n')) rest_.remove_prefix(1);
  }
  bool accept(char c) {
    blanks();
    if (rest_.empty() || rest_[0] != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(quoted_token(rest_.substr(0, 20)) + " instead of " + c);
  }
  std::string_view string() {
    const char quote = accept('\'') ? '\'' : '"';
    if (quote == '"') expect('"');
    const auto end = rest_.find(quote);
    if (end == std::string_view::npos) fail("a string without end");
    const auto value = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return value;
  }
  bool truth() {
    blanks();
    for (const bool value : {true, false}) {
      const std::string_view word = value ? "True" : "False";
      if (!rest_.starts_with(word)) continue;
      rest_.remove_prefix(word.size());
      return value;
    }
    fail(quoted_token(rest_.substr(0, 20)) + " as fortran_order");
  }
  std::int64_t integer() {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc() || value < 0) fail(quoted_token(rest_.substr(0, 20)) + " as an extent");
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  // Records are lists of types: derham has no use for them, but they may be skipped.
  void take_type(NpyArray& array) {
    blanks();
    if (rest_.starts_with("[")) {
      int depth = 0;
      do {
        if (rest_.empty()) fail("a type without end");
        if (rest_[0] == '\'') {
          (void)string();
          continue;
        }
        depth += rest_[0] == '[' ? 1 : rest_[0] == ']' ? -1 : 0;
        rest_.remove_prefix(1);
      } while (depth > 0);
      array.kind = 'V';
      array.item_bytes = 0;
      return;
    }
    const auto type = string();
    std::string_view size = type;
    array.swap = false;
    if (!size.empty() && (size[0] == '<' || size[0] == '>' || size[0] == '|' || size[0] == '=')) {
      array.swap = (size[0] == '<' && !is_little) || (size[0] == '>' && is_little);
      size.remove_prefix(1);
    }
    if (size.empty()) fail("the type " + quoted_token(type));
    array.kind = size[0];
    size.remove_prefix(1);
    array.item_bytes = array.kind == 'O' ? 8 : 0;
    if (size.empty() && array.kind == 'O') return;
    // A time has its unit behind the size, as in M8[s].
    if (array.kind == 'M' || array.kind == 'm') size = size.substr(0, size.find('['));
    const auto [end, error] = std::from_chars(size.data(), size.data() + size.size(), array.item_bytes);
    if (error != std::errc() || end != size.data() + size.size() || array.item_bytes < 0)
      fail("the type " + quoted_token(type));
    if (array.kind == 'U') {
      if (array.item_bytes > std::numeric_limits<int>::max() / 4) fail("the type " + quoted_token(type));
      array.item_bytes *= 4;
    }
  }

  void take_shape(NpyArray& array) {
    constexpr std::size_t most_extents = 32;
    array.shape.clear();
    expect('(');
    while (!accept(')')) {
      blanks();
      if (array.shape.size() == most_extents) fail("more than 32 extents");
      array.shape.push_back(integer());
      if (accept(',')) continue;
      expect(')');
      break;
    }
  }

  std::string_view rest_;
  const NpyFail& complain_;
};

}  // namespace

std::string NpyArray::shape_text() const {
  std::string out = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) out += (i > 0 ? ", " : "") + std::to_string(shape[i]);
  return out + (shape.size() == 1 ? ",)" : ")");
}

NpyArray parse_npy(std::string_view bytes, const NpyFail& fail) {
  if (!bytes.starts_with("\x93NUMPY") || bytes.size() < 10) fail("the array does not begin as numpy arrays do");
  const auto major = static_cast<unsigned char>(bytes[6]), minor = static_cast<unsigned char>(bytes[7]);
  if (major < 1 || major > 3 || minor != 0)
    fail(text("the array has format ", int{major}, ".", int{minor}, "; expected 1.0, 2.0 or 3.0"));
  const std::size_t start = major == 1 ? 10 : 12;
  if (bytes.size() < start) fail("the array ends within its header");
  const bool swap = is_foreign_order(true);
  const std::size_t length = major == 1 ? load_number<std::uint16_t>(bytes.data() + 8, swap)
                                        : load_number<std::uint32_t>(bytes.data() + 8, swap);
  if (length > bytes.size() - start) fail("the array ends within its header");
  NpyArray array;
  Header(bytes.substr(start, length), fail).parse(array);
  array.data = bytes.substr(start + length);

  if (array.kind == 'V' || array.kind == 'O') return array;  // of no known size
  const bool known_size = array.kind == 'f' || array.kind == 'i' || array.kind == 'u'
                              ? std::has_single_bit(static_cast<unsigned>(array.item_bytes)) && array.item_bytes <= 8
                              : array.item_bytes >= 0;
  if (!known_size && array.kind != 'f') fail(text("the array has numbers of ", array.item_bytes, " bytes"));
  // The product of the extents cannot overflow when each is compared with what is left. An extent 0 makes it 0.
  const bool is_empty = std::ranges::find(array.shape, 0) != array.shape.end();
  auto left = static_cast<std::int64_t>(array.data.size()) / std::max(array.item_bytes, 1);
  for (const auto extent : array.shape) left = extent > 0 ? left / extent : left;
  const bool fits = is_empty || left > 0 || array.item_bytes == 0;
  if (!fits || (is_empty || array.item_bytes == 0 ? 0 : array.count() * array.item_bytes) !=
                   static_cast<std::int64_t>(array.data.size()))
    fail(text("the array has ", array.data.size(), " bytes, which do not make the shape ", array.shape_text(), " of ",
              array.item_bytes, " bytes each"));
  return array;
}

std::string npy_header(char kind, std::size_t item_bytes, std::span<const std::int64_t> shape) {
  NpyArray array;
  array.shape.assign(shape.begin(), shape.end());
  const char order = item_bytes == 1 || kind == 'S' ? '|' : is_little ? '<' : '>';
  std::string dictionary =
      text("{'descr': '", order, kind, item_bytes, "', 'fortran_order': False, 'shape': ", array.shape_text(), ", }");
  constexpr std::size_t alignment = 64, start = 10;
  dictionary.append(alignment - (start + dictionary.size() + 1) % alignment, ' ') += '\n';
  return std::string("\x93NUMPY\x01", 7) + '\0' + static_cast<char>(dictionary.size() & 0xff) +
         static_cast<char>(dictionary.size() >> 8) + dictionary;
}

}  // namespace derham
