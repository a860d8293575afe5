#include "derham/io/npz_arrays.hpp"

#include "derham/core/text.hpp"
#include "derham/io/byte_order.hpp"

#include <cmath>
#include <cstddef>

namespace derham {
namespace {

constexpr std::string_view extension = ".npy";

std::string_view array_name(std::string_view entry) { return entry.substr(0, entry.size() - extension.size()); }

}  // namespace

NpzArrays::NpzArrays(Cursor& file) : archive_(file) {
  for (const auto& entry : archive_.entries())
    if (entry.name.ends_with(extension)) arrays_.emplace(array_name(entry.name), &entry);
}

std::vector<std::string_view> NpzArrays::unused() const {
  std::vector<std::string_view> names;
  for (const auto& entry : archive_.entries())
    if (entry.name.ends_with(extension) && !used_.contains(array_name(entry.name)))
      names.push_back(array_name(entry.name));
  return names;
}

std::vector<std::string_view> NpzArrays::others() const {
  std::vector<std::string_view> names;
  for (const auto& entry : archive_.entries())
    if (!entry.name.ends_with(extension)) names.emplace_back(entry.name);
  return names;
}

void NpzArrays::fail(const ZipArchive::Entry& entry, const std::string& message) {
  archive_.fail(entry.data, text(quoted_token(entry.name), ": ", message));
}

std::vector<double> npz_reals(const NpyArray& array, bool finite, const NpyFail& fail) {
  auto values = npy_reals(array, fail);
  for (std::size_t i = 0; finite && i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      fail(text("number ", i, " of the array is ", values[i], "; expected finite numbers"));
  return values;
}

void require_integers(const NpyArray& array, const NpyFail& fail) {
  if (!array.is_integer()) fail(text("the array has the type ", array.kind, array.item_bytes, "; expected integers"));
}

void require_shape(const NpyArray& array, const std::vector<std::int64_t>& shape, const char* why,
                   const NpyFail& fail) {
  if (array.shape == shape) return;
  NpyArray expected;
  expected.shape = shape;
  fail(text("the array has the shape ", array.shape_text(), "; expected ", expected.shape_text(), why));
}

// numpy fills texts up with zeros. Its Unicode is UTF-32.
std::string npz_text(const NpyArray& array, std::size_t i, const NpyFail& fail) {
  const auto width = static_cast<std::size_t>(array.item_bytes);
  auto item = array.data.substr(i * width, width);
  std::string out;
  if (array.kind == 'S') {
    while (!item.empty() && item.back() == '\0') item.remove_suffix(1);
    return std::string(item);
  }
  for (; item.size() >= 4; item.remove_prefix(4)) {
    const auto code = load_number<std::uint32_t>(item.data(), array.swap);
    if (code > 0x10ffff) fail(text("a text has the character ", code, "; expected at most 1114111"));
    const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
    if (code < 0x80) {
      put(code);
      continue;
    }
    if (code >= 0x10000)
      put(0xf0 | code >> 18);
    else if (code >= 0x800)
      put(0xe0 | code >> 12);
    else
      put(0xc0 | code >> 6);
    if (code >= 0x10000) put(0x80 | (code >> 12 & 0x3f));
    if (code >= 0x800) put(0x80 | (code >> 6 & 0x3f));
    put(0x80 | (code & 0x3f));
  }
  while (!out.empty() && out.back() == '\0') out.pop_back();
  return out;
}

}  // namespace derham
