#pragma once

#include <locale>
#include <span>
#include <sstream>
#include <string>

namespace derham {

/// Everything written one after the other, as `operator<<` would, whatever locale the program has set: for messages,
/// not for hot loops.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  (out << ... << parts);
  return out.str();
}

/// A tuple as "(3, 7, 9)".
template <class T>
std::string tuple_text(std::span<T> values) {
  std::string out = "(";
  for (std::size_t i = 0; i < values.size(); ++i) out += (i ? ", " : "") + std::to_string(values[i]);
  return out + ")";
}

}  // namespace derham
